"""Makes the npm package: the module, its scripts, and types from the schemas of the answers.

usage: package.py MODULE.wasm FOLDER VERSION
"""

import json
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[3]
SCHEMAS = ROOT / "docs/guide/pages/schema"
COMMANDS = ["align", "deviation", "distance", "flatten", "info", "remesh", "repair", "simplify"]
PLAIN = {"string": "string", "number": "number", "integer": "number", "boolean": "boolean", "null": "null"}


def members(schema):
    """The members of an object, those of schemas that it is joined from included."""
    required = schema.get("required", [])
    lines = []
    for name, one in schema.get("properties", {}).items():
        if isinstance(one, dict) and one.get("description"):
            lines.append("/** " + " ".join(one["description"].replace("*/", "* /").split()) + " */")
        lines.append(f"{json.dumps(name)}{'' if name in required else '?'}: {type_of(one)};")
    return "{ " + "\n".join(lines) + " }"


def type_of(schema):
    """The type of what a schema describes."""
    if not isinstance(schema, dict) or not schema:
        return "unknown"
    if "$ref" in schema:
        return schema["$ref"].split("/")[-1]
    if "const" in schema:
        return json.dumps(schema["const"])
    if "enum" in schema:
        return " | ".join(json.dumps(value) for value in schema["enum"])
    for key in ("oneOf", "anyOf"):
        if key in schema:
            either = " | ".join(f"({type_of(one)})" for one in schema[key])
            return f"{members(schema)} & ({either})" if "properties" in schema else either
    kinds = schema.get("type", "object" if "properties" in schema else None)
    if isinstance(kinds, list):
        return " | ".join(f"({type_of({**schema, 'type': kind})})" for kind in kinds)
    if kinds == "array":
        if "prefixItems" in schema:
            return "[" + ", ".join(map(type_of, schema["prefixItems"])) + "]"
        return f"({type_of(schema.get('items'))})[]"
    if kinds == "object":
        if "properties" in schema:
            return members(schema)
        more = schema.get("additionalProperties")
        return f"Record<string, {type_of(more) if isinstance(more, dict) else 'unknown'}>"
    if kinds in PLAIN:
        return PLAIN[kinds]
    return " & ".join(map(type_of, schema["allOf"])) if "allOf" in schema else "unknown"


def types():
    """A namespace for each command, whose schemas name their parts alike."""
    text = []
    for command in COMMANDS:
        schema = json.loads((SCHEMAS / f"{command}.json").read_text())
        parts = [f"type {name} = {type_of(part)};" for name, part in sorted(schema.get("$defs", {}).items())]
        text.append(f"declare namespace {command} {{\n" + "\n".join(parts) + f"\ntype CommandAnswer = {members(schema)};\n}}\n")
    rows = "\n".join(f"  {command}: {command}.CommandAnswer;" for command in COMMANDS)
    return "\n".join(text) + f"\n/** Answers by command. */\nexport interface Answers {{\n{rows}\n}}\n"


def main(wasm, folder, version):
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    shutil.copy(wasm, folder / "pompeiu.wasm")
    for path in [HERE / "index.js", HERE / "README.md", HERE.parent / "page/engine.js", ROOT / "LICENSE-MIT", ROOT / "LICENSE-APACHE"]:
        shutil.copy(path, folder)
    shutil.copytree(HERE / "examples", folder / "examples")
    (folder / "index.d.ts").write_text((HERE / "index.d.ts").read_text() + "\n// Made from the schemas of the answers.\n\n" + types())
    package = {
        "name": "pompeiu",
        "version": version,
        "description": "Distances and deviations of triangle meshes that are proven",
        "license": "MIT OR Apache-2.0",
        "type": "module",
        "exports": {".": {"types": "./index.d.ts", "default": "./index.js"}, "./pompeiu.wasm": "./pompeiu.wasm"},
        "types": "./index.d.ts",
        "sideEffects": False,
        "engines": {"node": ">=20"},
    }
    (folder / "package.json").write_text(json.dumps(package, indent=2) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
