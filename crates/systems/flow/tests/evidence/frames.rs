//! Surfaces kept on the way for a page.

use pompeiu_flow::show::Frames;
use pompeiu_flow::{FlowObserver, FlowRecord, FlowStep, GradientNorm, Scheme, StepReason};

#[test]
fn first_and_last_are_kept_and_the_others_thinned_out() {
    for steps in [1, 2, 3, 7, 8, 9, 100] {
        let frames = Frames::new(8);
        for step in 0..steps {
            let record = FlowRecord {
                time: None,
                area: 1.0,
                gradient: GradientNorm::default(),
                scheme: Scheme::Implicit,
                reason: StepReason::Scheme,
            };
            let at = FlowStep { step, record: &record, positions: &[], faces: &[], share: None };
            assert!(frames.step(&at).is_continue());
        }
        let kept: Vec<usize> = frames.into_frames().iter().map(|frame| frame.step).collect();
        assert!(kept.len() <= 9 && kept.is_sorted(), "{kept:?}");
        assert_eq!((kept[0], kept[kept.len() - 1]), (0, steps - 1));
    }
}
