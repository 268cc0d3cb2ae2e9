"""What `pompeiu flatten` writes, as other programs read it: trimesh and the glTF validator of Khronos."""

import json
import os
import shutil
import subprocess

import numpy as np
import pompeiu
import pytest
import trimesh


@pytest.fixture(scope="module")
def files(repository, tmp_path_factory):
    """A sphere and its flat map as OBJ and GLB, as the command wrote them."""
    folder = tmp_path_factory.mktemp("textures")
    target = os.environ.get("CARGO_TARGET_DIR") or repository / "target"
    sphere = pompeiu.shapes.icosphere(1.0, 2)
    pompeiu.write_mesh(folder / "sphere.obj", sphere)
    for name in ["flat.obj", "flat.glb"]:
        subprocess.run([f"{target}/debug/pompeiu", "flatten", "sphere.obj", "-o", name], cwd=folder, check=True)
    return folder, sphere


@pytest.mark.parametrize(("name", "accuracy"), [("flat.obj", 1e-7), ("flat.glb", 1e-6)])
def test_trimesh_reads_the_places_of_all_corners(files, name, accuracy):
    folder, sphere = files
    theirs = trimesh.load(folder / name, force="mesh", process=False)
    flat = pompeiu.flatten(sphere)
    assert theirs.faces.shape == flat.corners.shape
    # Corner by corner: the faces and their corners are in the order of the file.
    assert np.abs(theirs.vertices[theirs.faces] - sphere.vertices[sphere.faces]).max() < accuracy
    assert np.abs(theirs.visual.uv[theirs.faces] - flat.uv).max() < accuracy
    assert theirs.visual.material is not None


@pytest.mark.skipif(shutil.which("npm") is None, reason="npm is not installed")
def test_the_validator_of_khronos_finds_nothing(files, repository):
    folder, _ = files
    done = subprocess.run(
        ["bash", repository / "scripts/gltf-validator", folder / "flat.glb"], capture_output=True, text=True, check=True
    )
    report = json.loads(done.stdout)
    issues = report["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    assert report["info"]["hasTextures"] and report["info"]["totalTriangleCount"] == 320
