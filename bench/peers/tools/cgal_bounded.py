"""CGAL's bounded_error_Hausdorff_distance: one number, claimed to be within the tolerance of the distance."""

TITLE = "CGAL bounded error"
PROGRAM = "cgal bounded"
KIND = "bounded"
