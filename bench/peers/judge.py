"""Is an answer right? One function, so that every program is judged by the same words.

What is true is the certified enclosure [lower, upper] of pompeiu, computed to full precision before anything is timed,
or a closed form. Everybody is granted the tolerance that everybody was asked for.

    right    holds the distance, is no wider than asked, or is within the tolerance of it
    misses   a sampling tool found less than the maximum
    wide     an enclosure that holds the distance and is wider than asked
    wrong    all else: an enclosure that excludes the distance, is inverted or not finite; a number further from the
             distance than claimed; a sampling tool that found more than there is
"""

import math

# What an answer claims.
ENCLOSURE = "enclosure"  # [lower, upper] holds the distance
BOUNDED = "bounded"  # a number within the tolerance of the distance
VERTICES = "vertices"  # the largest distance of a vertex of A from the faces of B
SAMPLES = "samples"  # the largest distance of a sample of A from B, or from a sample of B
SAMPLED = (VERTICES, SAMPLES)


def judge(kind, answer, certified, tolerance):
    """Verdict, and what is wrong in words: `answer` has either `lower` and `upper` or `value`."""
    lower, upper = certified
    if kind == ENCLOSURE:
        return judge_enclosure(answer["lower"], answer["upper"], certified, tolerance)
    value = answer["value"]
    if math.isnan(value):
        return "wrong", "not a number"
    if math.isinf(value):
        return "wrong", "infinite"
    if value > upper + tolerance:
        return "wrong", f"{above(value, upper)} the distance"
    if value < lower - tolerance:
        share = 100 * (lower - value) / lower
        return ("misses", f"misses the maximum by {digits(share)} %") if kind in SAMPLED else (
            "wrong", f"{digits(share)} % below the distance")
    return "right", ""


def judge_enclosure(low, high, certified, tolerance):
    lower, upper = certified
    if math.isnan(low) or math.isnan(high):
        return "wrong", "not a number"
    if math.isinf(low) or math.isinf(high):
        return "wrong", "infinite"
    if low > high:
        return "wrong", f"inverted: {low:.6g} to {high:.6g}"
    if low > upper + tolerance:
        return "wrong", f"lower end {above(low, upper)} the distance"
    if high < lower - tolerance:
        return "wrong", f"upper end {digits(100 * (lower - high) / lower)} % below the distance"
    # A width is a difference of two rounded numbers: it may exceed the tolerance by their rounding.
    if high - low > tolerance + 2 * math.ulp(high):
        return "wide", f"{digits((high - low) / tolerance)} times as wide as asked"
    return "right", ""


def worst(kind, answers, certified, tolerance):
    """The answer that counts when there are several, with its verdict: sampling tools need not find the same twice."""
    judged = [(answer, *judge(kind, answer, certified, tolerance)) for answer in answers]
    return max(judged, key=lambda found: (found[1] != "right", off_by(found[0], certified)))


def off_by(answer, certified):
    """How far an answer is from the certified enclosure: 0 if they meet. In the unit of the meshes."""
    low, high = (answer["lower"], answer["upper"]) if "lower" in answer else (answer["value"],) * 2
    if math.isnan(low) or math.isnan(high):
        return math.inf
    return max(0.0, low - certified[1], certified[0] - high)


def above(value, upper):
    """How far above, in words."""
    if upper > 0 and (value - upper) / upper < 10:
        return f"{digits(100 * (value - upper) / upper)} % above"
    return f"{value:.3g}, above"


def digits(share):
    """A share in two digits, never rounded to nothing."""
    return f"{share:.0f}" if 9.95 <= share < 99_999 else f"{share:.2g}"
