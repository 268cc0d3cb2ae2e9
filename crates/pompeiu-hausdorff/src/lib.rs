//! Certified Pompeiu–Hausdorff distance between triangle meshes.
