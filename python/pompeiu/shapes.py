"""Shapes with known answers, as :class:`pompeiu.Mesh`."""

from ._native import cube, cylinder, grid, icosphere, schwarz_lantern, torus

__all__ = ["cube", "cylinder", "grid", "icosphere", "schwarz_lantern", "torus"]
