"""Writing of conformance/vectors: JSON with one case a line."""

import json
import pathlib

VECTORS = pathlib.Path(__file__).resolve().parents[2] / "conformance" / "vectors"


def write(name, made_by, **lists):
    parts = [f'"made_by": {json.dumps(made_by)}']
    for key, cases in lists.items():
        body = ",\n  ".join(json.dumps(case, ensure_ascii=False) for case in cases)
        parts.append(f'"{key}": [\n  {body}\n ]')
    (VECTORS / name).write_text("{\n " + ",\n ".join(parts) + "\n}\n", encoding="utf-8")
    print(name, {key: len(cases) for key, cases in lists.items()})


def plain(values):
    """Floats without negative zero, lists all the way down."""
    try:
        return [plain(value) for value in values]
    except TypeError:
        return float(values) + 0.0
