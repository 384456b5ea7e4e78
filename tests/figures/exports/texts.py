"""Hostile texts in the places of a robot that may hold text, through `urdd export moveit` and the programs that expand what
it writes: xacro evaluates nothing and gives back what `urdd export urdf` writes, Jinja renders nothing, PyYAML and libyaml
read every file, and the launch file assigns literals. The places and the texts are those of `tests/program/export/texts.rs`.

    pip install xacro==2.1.1 pyyaml==6.0.4 jinja2==3.1.6
    python3 tests/figures/exports/texts.py target/debug/urdd
"""

import ast
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from xml.sax.saxutils import escape

import jinja2
import xacro
import yaml

HERE = pathlib.Path(__file__).resolve().parents[2] / "program/export"
URDF = (HERE / "texts.urdf").read_text()
TEXTS = [*json.loads((HERE / "texts.json").read_text()), "x" * 2000]
# Names of one robot must differ; texts need not. The text takes the place of all of them at once.
NAMES = ["PlaceRobot", "PlaceBase", "PlaceJoint", "PlaceFollower"]
PLACES = sorted(set(re.findall(r"Place\w+", URDF)) - {"PlaceMarkup", "PlaceWhole"})
OTHERS = [place for place in PLACES if place not in (*NAMES, "PlaceMiddle", "PlaceTip", "PlaceLeft", "PlaceRight", "PlaceFixed", "PlaceFinger")]
evaluated = []


def watch(name):
    """What xacro evaluates, but for the expression that stands for `$`."""
    of = getattr(xacro, name)

    def watched(expression, *rest):
        if expression != "'$'":
            evaluated.append(expression)
        return of(expression, *rest)

    setattr(xacro, name, watched)


def replaced(found, places, text):
    if found in places or (found == "<whole>PlaceWhole</whole>" and "PlaceWhole" in places):
        return text
    if found.startswith("<"):
        for place in places:
            in_xml = escape(text, {'"': "&quot;", "'": "&apos;", "\t": "&#9;", "\n": "&#10;", "\r": "&#13;"})
            match place:
                case "PlaceData":
                    in_xml = text.replace("]]>", "]]]]><![CDATA[>")
                case "PlaceComment":
                    in_xml = text.replace("--", "- ")
                case "PlaceMarkup":
                    in_xml = text
            found = re.sub(rf"{place}\b", lambda _: in_xml, found)
    return found


def walk(value, change):
    match value:
        case str():
            return change(value)
        case list():
            return [walk(inner, change) for inner in value]
        case dict():
            return {change(key) if key.startswith("Place") else key: walk(inner, change) for key, inner in value.items()}
    return value


def tree(element):
    """An element, without what xacro may change: comments, white space, where a CDATA section begins."""
    # MoveIt's folder has simulated hardware in the place of the robot's.
    inner = [tree(child) for child in element if child.tag != "ros2_control"]
    parts = [element.text, *(child.tail for child in element)]
    texts = "".join("".join(part or "" for part in parts).split())
    attributes = sorted((key, " ".join(value.split())) for key, value in element.items() if key != "filename" or element.tag != "mesh")
    return element.tag, attributes, texts, inner


def export(program, urdd, form, target):
    done = subprocess.run([program, "export", form, str(urdd), "-o", str(target)], capture_output=True, text=True)
    return done.returncode == 0, done.stderr


def check(program, urdd, folder, text, names):
    plain, moveit = folder / "plain/robot.urdf", folder / "r_config"
    plain.parent.mkdir()
    is_plain, said = export(program, urdd, "urdf", plain)
    is_there, refused = export(program, urdd, "moveit", moveit)
    if not is_there:
        assert names and "cannot hold the name" in refused or not is_plain, refused
        return False
    for file in [*moveit.rglob("*.urdf"), *moveit.rglob("*.srdf")]:
        try:
            ET.parse(file)
        except ET.ParseError:
            print(file.read_text())
            raise
        read = xacro.process_file(str(file)).toprettyxml(indent="  ")
        assert not evaluated, (file, evaluated)
        if file.suffix == ".urdf" and "for MoveIt, are xacro's" not in refused:
            assert is_plain, said
            found, meant = tree(ET.fromstring(read)), tree(ET.parse(plain).getroot())
            assert found == meant, [pair for pair in zip(found[3], meant[3]) if pair[0] != pair[1]] or (found[:3], meant[:3])
    ET.parse(moveit / "package.xml")
    for file in [*moveit.rglob("*.yaml"), *moveit.rglob("*.rviz")]:
        rendered = jinja2.Template(file.read_text()).render()
        assert rendered.rstrip("\n") == file.read_text().rstrip("\n"), file
        assert yaml.safe_load(rendered) == yaml.load(rendered, yaml.CSafeLoader)
    launch = ast.parse((moveit / "launch/demo.launch.py").read_text())
    values = {node.targets[0].id: ast.literal_eval(node.value) for node in launch.body if isinstance(node, ast.Assign)}
    assert set(values) == {"package", "robot", "urdf", "srdf", "root_link", "controllers"}
    if names:
        assert (values["robot"], values["root_link"]) == (text, text + "2"), values
        limits = yaml.safe_load((moveit / "config/joint_limits.yaml").read_text())
        assert text + "3" in limits["joint_limits"]
    return True


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    watch("safe_eval")
    watch("eval_extension")
    written = refused = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "robot.urdf").write_text(URDF.replace("PlaceMesh", "PlaceMesh.stl"))
        (folder / "PlaceMesh.stl").write_text((HERE / "texts.stl").read_text())
        urdd = folder / "robot"
        subprocess.run([program, "generate", folder / "robot.urdf", "-o", urdd], check=True, capture_output=True)
        documents = {path: json.loads(path.read_text().replace("PlaceMesh.stl", "PlaceMesh")) for path in urdd.rglob("*.json")}
        for number, text in enumerate(TEXTS):
            # All names at once, then all other texts, then markup, which may not be well-formed.
            for kind, places in enumerate((NAMES, OTHERS, ["PlaceMarkup"], ["PlaceWhole"])):
                for path, document in documents.items():
                    for place in [places] if kind else [[name] for name in places]:
                        end = "" if kind or place == NAMES[:1] else str(NAMES.index(place[0]) + 1)
                        document = walk(document, lambda found: replaced(found, place, text + end))
                    path.write_text(json.dumps(document))
                target = folder / f"{number}_{kind}"
                target.mkdir()
                done = check(program, urdd, target, text, kind == 0)
                written, refused = written + done, refused + (not done)
    print(f"{written} packages of MoveIt were read as they were meant, {refused} refused")
    assert written > 3 * refused > 0


if __name__ == "__main__":
    main()
