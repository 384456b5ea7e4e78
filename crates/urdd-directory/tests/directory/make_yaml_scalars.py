"""Writes yaml_scalars.json: what two independent readers make of plain YAML scalars.

    python3 -m venv venv && venv/bin/pip install pyyaml==6.0.3 ruamel.yaml==0.19.1
    venv/bin/python make_yaml_scalars.py

PyYAML's SafeLoader reads YAML 1.1; ruamel.yaml, pure and set to 1.2, reads YAML 1.2 (with
deviations: it takes dates for dates, and underscores in numbers).
Each reading is [type, text]; floats are given by their repr, errors have the type "error".
"""

import json
import pathlib

import yaml
from ruamel.yaml import YAML

SCALARS = """
0 1 -1 +1 12 007 010 08 00 -010 0o10 0o8 0x1F 0x1f 0x -0x1F 0xg 0b11 0b12 1_000 0_1 0x_1 _1 1__0
1.0 -1.0 +1.0 1. -1. .5 -.5 +.5 0.5 00.5 010.5 1.5.5 1e5 1e-7 1e+7 1E5 1.0e5 1.0e-7 1.0e+7 1.0E+22
1.e5 1.e+5 .5e+5 -.5e+5 .5e5 e5 1e 1.0e 1.0e+ 1e999 -1.0e-400 1_0.5 1.0_1 1._5 ._5 . .. ...x - -- +
-0 -0.0 0.0 12345678901234567890 123456789012345678901234567890
.inf -.inf +.inf .Inf .INF .iNF .nan .NaN .NAN -.nan .Nan inf nan NaN Infinity -Infinity
null Null NULL nULL ~ ~~ none None nil
true True TRUE tRUE false False FALSE yes Yes YES yES no No NO on On ON off Off OFF y Y n N t f
1:30 1:3 1:60 01:30 12:30:45 1:30.5 -1:30 190:20:30 190:20:30.15 1:2:3:4 :30 1:
2001-01-01 2001-1-1 2001-01-1 2001-01-01T00:00:00Z 2001-1-1T1:00:00 2001-01-01T00:00:00.5+01:00
2001-01-01t00:00:00-5 2001-01 20010101 2001-01-01x 2001-01-01T00:00 1.2.3 1-2 1/2 1,000 1+1
= == << < <<< => base_link base-link base/link a.b a:b a#b @x `x %x 0link 1st x1 a?b é
""".split() + ["2001-01-01 00:00:00", "2001-01-01 00:00:00 +1", "yes sir", "1 2", "a b"]


def peers():
    ruamel = YAML(typ="safe", pure=True)
    ruamel.version = (1, 2)
    return {"yaml11": yaml.safe_load, "yaml12": ruamel.load}


def reading(load, text):
    try:
        value = load("- " + text)[0]
    except Exception:
        return ["error", ""]
    kind = type(value).__name__
    names = {"ScalarInt": "int", "ScalarFloat": "float", "NoneType": "null", "TimeStamp": "datetime"}
    return [names.get(kind, kind), str(value) if isinstance(value, str) else repr(value)]


def main():
    table = [
        {"text": text} | {name: reading(load, text) for name, load in peers().items()}
        for text in dict.fromkeys(SCALARS)
    ]
    rows = ",\n".join(json.dumps(row, ensure_ascii=False) for row in table)
    pathlib.Path(__file__).with_name("yaml_scalars.json").write_text(f"[\n{rows}\n]\n", encoding="utf-8")


main()
