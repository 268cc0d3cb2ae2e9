"""The package as a whole: documentation that runs, types that are true, notebooks that work."""

import ast
import doctest
import importlib
import inspect
import pkgutil
import re
import shutil
import sys
from pathlib import Path
from typing import Any, get_args

import nbclient
import nbformat
import pompeiu
import pytest

FOLDER = Path(pompeiu.__file__).parent
MODULES = ["pompeiu", *(f"pompeiu.{m.name}" for m in pkgutil.iter_modules([str(FOLDER)]) if not m.name.startswith("_"))]


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_the_documentation_run(name):
    module = importlib.import_module(name)
    assert module.__doc__
    assert doctest.testmod(module).failed == 0


@pytest.mark.parametrize("page, least", [("python.md", 15), ("ray.md", 8)])
def test_pages_of_the_guide_are_true(page, least, repository, tmp_path, monkeypatch):
    for example in (repository / "examples" / "meshes").glob("*.obj"):
        shutil.copy(example, tmp_path)
    monkeypatch.chdir(tmp_path)
    page = repository / "docs" / "guide" / "pages" / page
    # The end of a block is no output.
    text = page.read_text(encoding="utf-8").replace("\n```", "\n\n")
    test = doctest.DocTestParser().get_doctest(text, {}, page.name, str(page), 0)
    assert len(test.examples) > least
    flags = doctest.IGNORE_EXCEPTION_DETAIL
    assert doctest.DocTestRunner(optionflags=flags).run(test).failed == 0


def test_everything_public_is_documented():
    assert "MeshLike" in pompeiu.__all__, "an alias, which cannot have a documentation of its own"
    for name in pompeiu.__all__:
        thing = getattr(pompeiu, name)
        if inspect.isclass(thing) or inspect.isroutine(thing):
            assert inspect.getdoc(thing), name
        if inspect.isclass(thing):
            for member, value in vars(thing).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert inspect.getdoc(value), f"{name}.{member}"


def test_types_are_there_and_name_what_is_there():
    assert (FOLDER / "py.typed").exists()
    stubs = ast.parse((FOLDER / "_native.pyi").read_text(encoding="utf-8"))
    native = importlib.import_module("pompeiu._native")
    stated = {}
    for node in stubs.body:
        if isinstance(node, ast.ClassDef):
            stated[node.name] = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            stated[node.name] = [argument.arg for argument in node.args.args]
    for name, thing in vars(native).items():
        if name.startswith("_"):
            continue
        if inspect.isclass(thing):
            members = {m for m in vars(thing) if not m.startswith("__") and m != "__doc__"}
            assert members == {m for m in stated[name] if not m.startswith("__")}, name
        else:
            assert list(inspect.signature(thing).parameters) == stated[name], name
        del stated[name]
    assert not stated, "named in the stubs only"


def test_the_version_is_that_of_the_crates(repository):
    manifest = (repository / "Cargo.toml").read_text(encoding="utf-8")
    assert f'version = "{pompeiu.__version__}"' in manifest


def test_only_numpy_is_needed():
    for file in FOLDER.glob("*.py"):
        nodes = list(ast.walk(ast.parse(file.read_text(encoding="utf-8"))))
        imported = [one.name for node in nodes if isinstance(node, ast.Import) for one in node.names]
        imported += ["." * node.level + (node.module or "") for node in nodes if isinstance(node, ast.ImportFrom)]
        for name in imported:
            known = {"numpy", *sys.stdlib_module_names}
            if (file.stem, name) in {("ray", "ray"), ("progress", "tqdm.auto")}:
                continue
            assert name.startswith(".") or name.split(".")[0] in known, f"{file.name} imports {name}"


def notebooks():
    return sorted((Path(__file__).parents[2] / "examples" / "python").glob("*.ipynb"))


def shown(cell):
    """What a cell printed, without times and places in memory, and what kinds of pictures it shows."""
    texts = []
    for output in cell.get("outputs", []):
        data = output.get("data", {"text/plain": output.get("text", "")})
        kinds, text = sorted(data), "".join(data.get("text/plain", ""))
        stream = output.get("name")
        # What a cell prints arrives in one message or, on a busy machine, in several.
        if stream and texts and texts[-1][0] == stream:
            text = texts.pop()[2] + text
        texts.append((stream, kinds, text))
    return [(kinds, re.sub(r"0x[0-9a-f]+|\d[\d.]* ?m?s\b", "", text)) for _, kinds, text in texts]


@pytest.mark.parametrize("path", notebooks(), ids=lambda path: path.name)
def test_notebooks_run_from_a_folder_of_their_own(path, tmp_path):
    notebook = nbformat.read(path, as_version=4)
    kept = [shown(cell) for cell in notebook.cells]
    nbclient.NotebookClient(notebook, timeout=None, resources={"metadata": {"path": str(tmp_path)}}).execute()
    assert kept == [shown(cell) for cell in notebook.cells], "run the notebook again and keep its outputs"
    assert any(kept)


def test_what_is_no_mesh_is_no_mesh_for_type_checkers_either():
    assert Any not in get_args(pompeiu.MeshLike) and len(get_args(pompeiu.MeshLike)) > 4
