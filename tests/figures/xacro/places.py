"""Holds the places of `urdd lint` in xacro files to what the files say, with xacro itself.

    python places.py URDD

`robot/main.xacro` says of each of its elements where its attribute `v` is from. Its output has to be byte for byte that of
xacro without us. The rest are small robots with one fault, by way of `urdd lint`. Needs xacro and PyYAML in this Python.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from xml.dom import minidom

HERE = Path(__file__).resolve().parent
WATCH = HERE.parents[2] / "crates/urdd-source/src/watch"
RUN = "import sys; from xacro import main; sys.exit(main())"


def xacro(folder, watched):
    python = os.environ.get("PYTHONPATH", "")
    environment = dict(os.environ, URDD_XACRO_PLACES=str(folder / "notes.json"))
    if watched:
        environment["PYTHONPATH"] = f"{folder}:{python}"
    words = [sys.executable, "-c", RUN, str(HERE / "robot/main.xacro"), "typed:=y"]
    return subprocess.run(words, env=environment, capture_output=True, check=False)


def table(folder):
    """The places of values in `robot`: of attributes, not yet of their columns in the element, which urdd finds."""
    for name, file in [("xacro/__init__.py", "xacro.py"), ("urdd_xacro/documents.py", None), ("urdd_xacro/macros.py", None)]:
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text((WATCH / (file or path.name)).read_text())
    (folder / "urdd_xacro/__init__.py").touch()
    plain, watched = xacro(folder, False), xacro(folder, True)
    assert plain.returncode == 0, plain.stderr.decode()
    assert (watched.stdout, watched.stderr) == (plain.stdout, plain.stderr), "xacro's output changed"
    noted = json.loads((folder / "notes.json").read_text())
    elements = minidom.parseString(watched.stdout).getElementsByTagName("*")
    assert len(elements) == len(noted["elements"])
    values = {(number, name): place for number, name, place in noted["values"]}
    wrong = []
    for number, element in enumerate(elements):
        if element.tagName != "e":
            continue
        place = values.get((number, "v"))
        found = place and f"{Path(noted['files'][place[0]]).name}:{column(noted['files'], place)}"
        expected = (element.getAttribute("at").split() + [None])[1]
        if found != expected:
            wrong.append(f"{element.getAttribute('at')}: found {found}")
    assert not wrong, "\n".join(wrong)
    return len([1 for element in elements if element.tagName == "e"])


def column(files, place):
    """Line and column of an attribute in the element at a place, or of a parameter in it."""
    number, line, begin, attribute, parameter = place
    text = Path(files[number]).read_text()
    offset = sum(len(one) for one in text.splitlines(True)[: line - 1]) + begin - 1
    if attribute:
        offset = text.index(f" {attribute}=", offset) + 1
    if parameter:
        starts = [text.find(f"{before}{parameter}:=", offset) for before in '" ']
        offset = min(start for start in starts if start >= 0) + 1
    return f"{text.count(chr(10), 0, offset) + 1}:{offset - text.rfind(chr(10), 0, offset)}"


HEAD = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"'
LINK = """  <link name="${name}"><inertial><mass value="${%s}"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
"""
CALL = '  <xacro:include filename="part.xacro"/>\n'
PART = f'{HEAD}>\n  <xacro:macro name="part" params="name mass">\n{LINK % "mass"}  </xacro:macro>\n</robot>\n'
OUTER = f'{HEAD}>\n{CALL}  <xacro:macro name="outer" params="m">\n    <xacro:part name="a" mass="${{m}}"/>\n  </xacro:macro>\n</robot>\n'


def main_file(body):
    return f'{HEAD} name="r">\n{CALL}{body}</robot>\n'


# The axis is an attribute's finding, and the mass an element's.
SLIDE = """  <link name="a"/><link name="b"/>
  <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><limit lower="0" upper="1" effort="1" velocity="1"/>
    <axis xyz="${axis}"/></joint>
"""

# By name: the files, and where `urdd lint` says that the mass is negative, SRC003, or the axis is not of length 1, LNT012.
FINDINGS = {
    "at a call": (
        {"urdf/r.urdf.xacro": main_file('  <xacro:part name="a" mass="-1"/>\n'), "urdf/part.xacro": PART},
        "r.urdf.xacro:3:24 by part.xacro:3:34 (part) called at r.urdf.xacro:3:3",
    ),
    "through two calls": (
        {
            "urdf/r.urdf.xacro": f'{HEAD} name="r">\n  <xacro:include filename="outer.xacro"/>\n  <xacro:outer m="-1"/>\n</robot>\n',
            "urdf/outer.xacro": OUTER,
            "urdf/part.xacro": PART,
        },
        "r.urdf.xacro:3:16 by part.xacro:3:34 (part) called at outer.xacro:4:5 called at r.urdf.xacro:3:3",
    ),
    "in a file of YAML": (
        {
            "urdf/r.urdf.xacro": main_file(
                "  <xacro:property name=\"y\" value=\"${xacro.load_yaml('../config/y.yaml')}\"/>\n"
                "  <xacro:part name=\"a\" mass=\"${y['a']['mass']}\"/>\n"
            ),
            "urdf/part.xacro": PART,
            "config/y.yaml": "# masses\na:\n  mass: -1\n",
        },
        "../config/y.yaml:3:9 by part.xacro:3:34 (part) called at r.urdf.xacro:4:3",
    ),
    "of an attribute": (
        {"urdf/r.urdf.xacro": f'{HEAD} name="r">\n  <xacro:property name="axis" value="0 0 2"/>\n{SLIDE}</robot>\n'},
        "r.urdf.xacro:2:31 by r.urdf.xacro:5:11",
    ),
    "of an attribute with a literal beside": (
        {
            "urdf/r.urdf.xacro": f'{HEAD} name="r">\n  <xacro:property name="axis" value="2"/>\n{SLIDE}</robot>\n'.replace(
                "${axis}", "0 0 ${axis}"
            )
        },
        "r.urdf.xacro:5:11",
    ),
    "in the macro": (
        {
            "urdf/r.urdf.xacro": main_file('  <xacro:part name="a" mass="1"/>\n'),
            "urdf/part.xacro": PART.replace("${mass}", "-1"),
        },
        "part.xacro:3:34 (part) called at r.urdf.xacro:3:3",
    ),
    "of two literals": (
        {
            "urdf/r.urdf.xacro": main_file('  <xacro:property name="d" value="-2"/>\n  <xacro:part name="a" mass="${d + 1}"/>\n')
            .replace("${d + 1}", "${d + e}")
            .replace("  <xacro:part", '  <xacro:property name="e" value="1"/>\n  <xacro:part'),
            "urdf/part.xacro": PART,
        },
        "part.xacro:3:34 (part) called at r.urdf.xacro:5:3",
    ),
}

# By name: the files, and the place and a word of what `urdd lint` says of a robot that cannot be made.
UNREADABLE = {
    "undefined parameter": (
        {"urdf/r.urdf.xacro": main_file('  <xacro:part name="a"/>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:3:3: `xacro` could not expand it",
        "Undefined parameters [mass]",
    ),
    "invalid parameter": (
        {"urdf/r.urdf.xacro": main_file('  <xacro:part name="a" mas="1"/>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:3:24:",
        "mas",
    ),
    "unknown macro": (
        {"urdf/r.urdf.xacro": main_file("  <xacro:prat/>\n"), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:3:3:",
        "prat",
    ),
    "undefined name in a macro": (
        {
            "urdf/r.urdf.xacro": main_file('  <xacro:part name="a" mass="1"/>\n'),
            "urdf/part.xacro": PART.replace("${mass}", "${mas}"),
        },
        "urdf/part.xacro:3:40: `xacro` could not expand ./urdf/r.urdf.xacro",
        "by the macro `part`, called at ./urdf/r.urdf.xacro:3:3",
    ),
    "missing include": (
        {"urdf/r.urdf.xacro": main_file('  <xacro:include filename="no.xacro"/>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:3:3:",
        "urdf/no.xacro",
    ),
    "missing package": (
        {"urdf/r.urdf.xacro": main_file('  <xacro:include filename="$(find no_such)/a.xacro"/>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:3:18:",
        "--package no_such=FOLDER",
    ),
    "XML of an included file": (
        {"urdf/r.urdf.xacro": main_file(""), "urdf/part.xacro": PART.replace("</link>", "</lin>")},
        "urdf/part.xacro:3:",
        "mismatched tag",
    ),
    "XML of the file": (
        {"urdf/r.urdf.xacro": f'{HEAD} name="r">\n  <link name="a">\n</robot>\n'},
        "urdf/r.urdf.xacro:3:3:",
        "mismatched tag",
    ),
    "YAML": (
        {
            "urdf/r.urdf.xacro": main_file("  <link name=\"${xacro.load_yaml('../config/y.yaml')['a']}\"/>\n"),
            "urdf/part.xacro": PART,
            "config/y.yaml": "a: 1\nb: [1, 2\nc: 3\n",
        },
        "config/y.yaml:3:",
        "could not expand ./urdf/r.urdf.xacro",
    ),
    "missing YAML": (
        {
            "urdf/r.urdf.xacro": main_file("  <link name=\"${xacro.load_yaml('../config/y.yaml')['a']}\"/>\n"),
            "urdf/part.xacro": PART,
        },
        "urdf/r.urdf.xacro:3:9:",
        "config/y.yaml",
    ),
    "missing attribute": (
        {"urdf/r.urdf.xacro": main_file('  <link name="a"/>\n  <xacro:property value="1"/>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:4:3:",
        "missing attribute",
    ),
    "undefined block": (
        {"urdf/r.urdf.xacro": main_file('  <link name="a">\n    <xacro:insert_block name="b"/>\n  </link>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:4:5:",
        "Undefined block",
    ),
    "condition": (
        {"urdf/r.urdf.xacro": main_file('  <link name="a"/>\n  <xacro:if value="maybe"/>\n'), "urdf/part.xacro": PART},
        "urdf/r.urdf.xacro:4:3:",
        "not a boolean",
    ),
    "property that is used elsewhere": (
        {
            "urdf/r.urdf.xacro": main_file('  <xacro:property name="m" value="${no_such}"/>\n  <xacro:part name="a" mass="${m}"/>\n'),
            "urdf/part.xacro": PART,
        },
        "urdf/r.urdf.xacro:3:28:",
        "no_such",
    ),
}


def lint(urdd, files, form):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
        words = [urdd, "lint", ".", "--xacro", "--format", form]
        path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
        done = subprocess.run(words, cwd=folder, env=dict(os.environ, PATH=path), capture_output=True, text=True, check=False)
        # The folder of a test has an absolute path, and no message may have it.
        assert os.path.realpath(folder) not in done.stdout.replace(f"file={folder}", ""), done.stdout
        return done.stdout


def at(place):
    macro = f" ({place['macro_name']})" if place["macro_name"] else ""
    return f"{place['file']}:{place['line']}:{place['column']}{macro}"


def finding(urdd, files):
    report = json.loads(lint(urdd, files, "json"))
    (found,) = [one for one in report["urdds"][0]["findings"] if one["code"] in ("SRC003", "LNT012")]
    written = found["places"][0]["written_at"]
    assert (found["file"], found["line"]) == (written["file"], written["line"])
    words = [at(written)]
    words += [f"by {at(written['used_at'])}"] if written["used_at"] else []
    words += [f"called at {at(dict(call, macro_name=None))}" for call in written["calls"]]
    return " ".join(words)


def main():
    urdd = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        cases = table(Path(folder))
    wrong = []
    for name, (files, expected) in FINDINGS.items():
        found = finding(urdd, files)
        if found != expected:
            wrong.append(f"{name}:\n  expected {expected}\n  found    {found}")
    for name, (files, *expected) in UNREADABLE.items():
        found = lint(urdd, files, "human")
        if not all(words in found for words in expected):
            wrong.append(f"{name}:\n  expected {' ... '.join(expected)}\n  found    {found}")
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{cases} values, {len(FINDINGS)} findings and {len(UNREADABLE)} robots that cannot be made are where they are")


if __name__ == "__main__":
    main()
