"""Compares what urdd-usd composes with what usd-core does: every prim's type, schemas, attributes and relationships.

    cargo run --release -p urdd-usd --example dump -- FILE... | python usd.py
"""

import json
import math
import os
import sys

from pxr import Gf, Sdf, Tf, Usd, Vt


def number(value):
    return value if math.isfinite(value) else {"inf": "inf", "-inf": "-inf"}.get(str(value), "NaN")


def plain(value, folder):
    """A value as the dump has it."""
    if isinstance(value, bool) or value is None:
        return value
    if isinstance(value, (int, float)):
        return number(float(value))
    if isinstance(value, str):
        return value
    if isinstance(value, Sdf.AssetPath):
        if not value.path:
            return {"asset": ""}
        path = value.resolvedPath or value.path
        return {"asset": os.path.relpath(path, folder) if os.path.isabs(path) else path}
    if isinstance(value, Sdf.TimeCode):
        return number(value.GetValue())
    if isinstance(value, (Gf.Quath, Gf.Quatf, Gf.Quatd)):
        return [number(value.real), *[number(float(part)) for part in value.imaginary]]
    if isinstance(value, (Gf.Matrix2d, Gf.Matrix3d, Gf.Matrix4d)):
        return [number(part) for row in value for part in row]
    if isinstance(value, dict):
        return {key: plain(part, folder) for key, part in value.items()}
    if hasattr(value, "__len__"):
        if isinstance(value, Sdf.AssetPathArray):
            return [part.path for part in value]
        return [plain(part, folder) for part in value]
    return str(value)


def same(ours, theirs):
    if isinstance(ours, bool) or isinstance(theirs, bool):
        return float(ours or 0) == float(theirs or 0)
    if isinstance(ours, (int, float)) and isinstance(theirs, (int, float)):
        return float(ours) == float(theirs)
    if isinstance(ours, list) and isinstance(theirs, list):
        return len(ours) == len(theirs) and all(same(a, b) for a, b in zip(ours, theirs))
    return ours == theirs


def value_of(attribute):
    """The default value, or else the first by time."""
    if not attribute.HasAuthoredValue():
        return None
    source = attribute.GetResolveInfo(Usd.TimeCode.Default()).GetSource()
    if source == Usd.ResolveInfoSourceDefault or not attribute.GetNumTimeSamples():
        return attribute.Get()
    return attribute.Get(attribute.GetTimeSamples()[0])


def compare(dumped, totals, say):
    file = dumped["file"]
    folder = os.path.dirname(os.path.abspath(file))
    try:
        stage = Usd.Stage.Open(file)
    except (Tf.ErrorException, RuntimeError) as why:
        say(f"{file}: usd-core refuses it: {str(why)[:100]!r}; ours: {dumped.get('error')}")
        totals["refused by usd-core"] += 1
        return
    if "error" in dumped:
        faults = stage.GetCompositionErrors() if hasattr(stage, "GetCompositionErrors") else []
        say(f"{file}: {dumped['error']}; faults for usd-core: {len(faults)}")
        totals["refused by both" if faults else "refused by ours"] += 1
        return
    prims, wrong = dict(dumped["prims"]), []
    for prim in Usd.PrimRange(
            stage.GetPseudoRoot(), Usd.TraverseInstanceProxies(Usd.PrimIsActive & Usd.PrimIsDefined & ~Usd.PrimIsAbstract)):
        path = str(prim.GetPath())
        if path == "/":
            continue
        ours = prims.pop(path, None)
        totals["prims"] += 1
        if ours is None:
            wrong.append(f"{path} is missing")
            continue
        if ours["type"] != str(prim.GetTypeName()):
            wrong.append(f"{path}: type {ours['type']} for {prim.GetTypeName()}")
        listed = prim.GetPrimTypeInfo().GetAppliedAPISchemas()
        if ours["schemas"] != [str(name) for name in listed]:
            wrong.append(f"{path}: schemas {ours['schemas']} for {listed}")
        properties = dict(ours["properties"])
        for attribute in prim.GetAuthoredAttributes():
            totals["attributes"] += 1
            own = properties.pop(attribute.GetName(), None)
            if own is None:
                wrong.append(f"{path}.{attribute.GetName()} is missing")
                continue
            try:
                value = plain(value_of(attribute), folder)
            except (Tf.ErrorException, RuntimeError):
                totals["unread by usd-core"] += 1
                continue
            if not same(own["value"], value):
                wrong.append(f"{path}.{attribute.GetName()} = {str(own['value'])[:80]} for {str(value)[:80]}")
            if own["targets"] != [str(one) for one in attribute.GetConnections()]:
                wrong.append(f"{path}.{attribute.GetName()} connects to {own['targets']} for {attribute.GetConnections()}")
            # Schemas say the types of what is theirs, whatever a layer says.
            if own["type"] != str(attribute.GetTypeName()) and attribute.IsCustom():
                wrong.append(f"{path}.{attribute.GetName()}: type {own['type']} for {attribute.GetTypeName()}")
        for relationship in prim.GetAuthoredRelationships():
            totals["relationships"] += 1
            own = properties.pop(relationship.GetName(), None)
            if own is None:
                wrong.append(f"{path}.{relationship.GetName()} is missing")
            elif own["targets"] != [str(one) for one in relationship.GetTargets()]:
                wrong.append(f"{path}.{relationship.GetName()} is {own['targets']} for {relationship.GetTargets()}")
        wrong += [f"{path}.{name} is too much" for name in properties]
    wrong += [f"{path} is too much" for path in prims]
    totals["files"] += 1
    totals["equal"] += not wrong
    totals["seconds"] += dumped["seconds"]
    totals["differences"] += len(wrong)
    for line in wrong[:8]:
        say(f"{file}: {line}")


def main():
    totals = dict.fromkeys(
        ["files", "equal", "refused by ours", "refused by both", "unread by usd-core", "refused by usd-core", "prims", "attributes", "relationships", "differences", "seconds"], 0)
    for line in sys.stdin:
        compare(json.loads(line), totals, print)
    print(json.dumps(totals))
    return 0 if totals["equal"] == totals["files"] else 1


if __name__ == "__main__":
    sys.exit(main())
