"""Paths and meshes that tests share."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def repository():
    """The root of the repository."""
    return Path(__file__).parents[2]
