//! Every operation on intervals encloses the exact results for all members.

use pompeiu_core::exact::Interval;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::exact::Fraction;
use proptest::prelude::*;

/// Doubles of every size, sign and kind that is finite.
fn any_finite() -> impl Strategy<Value = f64> + Clone {
    use prop::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    let special = [0.0, -0.0, 1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, 2.0_f64.powi(-537)];
    prop_oneof![
        3 => POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO,
        2 => -2.0..2.0_f64,
        1 => (-8..9_i32).prop_map(f64::from),
        1 => prop::sample::select(special.to_vec()),
    ]
}

/// An interval and the exact value of one of its members.
#[derive(Clone, Debug)]
struct Held {
    interval: Interval,
    member: Fraction,
}

/// A point, a double's neighbourhood with one of its ends, or a wide interval with its middle or an end.
fn held() -> impl Strategy<Value = Held> + Clone {
    (any_finite(), any_finite(), 0..3_u32, 0..3_u32).prop_map(|(x, wide, kind, which)| {
        let member_of = |x: f64| match which {
            0 if x.next_down().is_finite() => x.next_down(),
            1 if x.next_up().is_finite() => x.next_up(),
            _ => x,
        };
        match kind {
            0 => Held { interval: Interval::point(x), member: Fraction::from_f64(x) },
            1 => Held { interval: Interval::around(x), member: Fraction::from_f64(member_of(x)) },
            _ => {
                let offset = Interval::around(wide) - Interval::point(wide);
                let member = Fraction::from_f64(member_of(wide)).plus(&Fraction::from_f64(-wide));
                Held { interval: offset + Interval::point(x), member: member.plus(&Fraction::from_f64(x)) }
            }
        }
    })
}

fn holds(interval: Interval, exact: &Fraction) -> bool {
    at_most(interval.lower(), exact) && at_least(interval.upper(), exact)
}

fn at_most(lower: f64, exact: &Fraction) -> bool {
    lower == f64::NEG_INFINITY || lower.is_finite() && Fraction::from_f64(lower) <= *exact
}

fn at_least(upper: f64, exact: &Fraction) -> bool {
    upper == f64::INFINITY || upper.is_finite() && Fraction::from_f64(upper) >= *exact
}

fn negative(x: &Fraction) -> Fraction {
    x.times(&Fraction::from_f64(-1.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(4000)))]

    #[test]
    fn sums_differences_products_and_squares(x in held(), y in held()) {
        let (p, q) = (&x.member, &y.member);
        prop_assert!(holds(x.interval, p));
        prop_assert!(holds(x.interval + y.interval, &p.plus(q)));
        prop_assert!(holds(x.interval - y.interval, &p.plus(&negative(q))));
        prop_assert!(holds(-x.interval, &negative(p)));
        prop_assert!(holds(x.interval * y.interval, &p.times(q)));
        prop_assert!(holds(x.interval.square(), &p.square()));
        prop_assert!(x.interval.square().lower() >= 0.0);
    }

    /// Compares squares and products, which are exact where roots and quotients are not.
    #[test]
    fn roots_and_quotients(x in held(), y in held()) {
        let zero = Fraction::from_f64(0.0);
        let root = x.interval.sqrt();
        prop_assert!(root.lower() >= 0.0);
        if x.member >= zero {
            prop_assert!(Fraction::from_f64(root.lower()).square() <= x.member);
            prop_assert!(root.upper() == f64::INFINITY || Fraction::from_f64(root.upper()).square() >= x.member);
        }
        if y.member > zero {
            let quotient = x.interval.divide_by_positive(y.interval);
            let times_member = |end: f64| Fraction::from_f64(end).times(&y.member);
            prop_assert!(quotient.lower() == f64::NEG_INFINITY || times_member(quotient.lower()) <= x.member);
            prop_assert!(quotient.upper() == f64::INFINITY || times_member(quotient.upper()) >= x.member);
        }
    }

    /// Results for points are two steps wide, where they are neither huge nor tiny.
    #[test]
    fn operations_on_points_round_by_a_step_to_either_side(x in -2.0..2.0_f64, y in 0.5..2.0_f64) {
        let (p, q) = (Interval::point(x), Interval::point(y));
        for z in [p + q, p - q, p * q, p.divide_by_positive(q), q.sqrt(), p.square()] {
            prop_assert!(z.upper() <= z.lower().next_up().next_up() || z.lower() == 0.0, "{z:?}");
        }
    }
}

#[test]
fn what_is_not_a_number_is_anything() {
    for whole in [
        Interval::point(f64::NAN),
        Interval::point(f64::INFINITY) - Interval::point(f64::INFINITY),
        Interval::point(0.0) * Interval::point(f64::INFINITY),
        Interval::point(1.0).divide_by_positive(Interval::point(0.0)),
    ] {
        assert_eq!(whole, Interval::WHOLE);
    }
}
