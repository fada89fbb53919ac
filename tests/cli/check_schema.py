"""usage: check_schema.py [SCHEMA FILE]

Prints where FILE does not follow docs/schema/SCHEMA, or without arguments what is wrong with the
schemas themselves: keys without a description, objects that would let unknown keys pass. The exit
code is 0 if nothing was printed, else 1.
"""

import json
import pathlib
import sys

import jsonschema

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs" / "schema"


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def faults_of_document(schema_name, path):
    schemas = {path.name: read(path) for path in FOLDER.glob("*.schema.json")}
    resolver = jsonschema.RefResolver("", schemas[schema_name], store=schemas)
    validator = jsonschema.Draft202012Validator(schemas[schema_name], resolver=resolver)
    for error in validator.iter_errors(read(path)):
        place = "/".join(str(part) for part in error.absolute_path)
        yield f"{path} at /{place}: {error.message[:300]}"


def faults_of_schema(schema, place):
    """Of a schema and those below it."""
    if not isinstance(schema, dict):
        return
    if not schema.get("description"):
        yield f"{place}: has no description"
    if "properties" in schema and schema.get("additionalProperties") is not False:
        yield f"{place}: lets unknown keys pass"
    for kind in ("properties", "$defs"):
        for name, below in schema.get(kind, {}).items():
            yield from faults_of_schema(below, f"{place}/{name}")
    yield from faults_of_schema(schema.get("items"), f"{place}/items")
    yield from faults_of_schema(schema.get("additionalProperties"), f"{place}/*")
    for i, below in enumerate(schema.get("prefixItems", [])):
        yield from faults_of_schema(below, f"{place}/{i}")


def faults_of_schemas():
    for path in sorted(FOLDER.glob("*.schema.json")):
        schema = read(path)
        jsonschema.Draft202012Validator.check_schema(schema)
        yield from faults_of_schema(schema, path.name)


def main(arguments):
    if len(arguments) == 2:
        faults = list(faults_of_document(arguments[0], pathlib.Path(arguments[1])))
    elif not arguments:
        faults = list(faults_of_schemas())
    else:
        sys.exit(__doc__)
    for fault in faults[:20]:
        print(fault)
    sys.exit(1 if faults else 0)


main(sys.argv[1:])
