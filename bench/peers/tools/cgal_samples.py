"""CGAL's approximate_Hausdorff_distance: the farthest of its vertices and of random points on its faces."""

TITLE = "CGAL approximate"
PROGRAM = "cgal sampled"
KIND = "samples"
