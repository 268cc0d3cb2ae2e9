"""cascading_upper_bounds: branch and bound, by the authors of the method of 2024. Claims an enclosure."""

TITLE = "cascading_upper_bounds"
PACKAGE = "cascading_upper_bounds"
KIND = "enclosure"


def prepare(a, b, tolerance, samples):
    from cascading_upper_bounds import pompeiu_hausdorff
    return pompeiu_hausdorff, (*a, *b), tolerance


def measure(prepared):
    pompeiu_hausdorff, meshes, tolerance = prepared
    lower, upper, *_ = pompeiu_hausdorff(*meshes, tol=tolerance)
    return lower, upper
