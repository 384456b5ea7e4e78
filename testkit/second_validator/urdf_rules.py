"""The rules of `urdf_module` (6.1.2 to 6.1.6)."""

from __future__ import annotations

from typing import Any

from .modules import Urdd, file_of
from .numeric import agree
from .urdf import read_urdf
from .xmltree import NotXml

FILE = file_of("urdf_module")
OF_JOINT = ("name", "joint_type", "origin", "parent", "child", "axis", "limit", "mimic")
REST_OF_JOINT = ("dynamics", "safety_controller", "calibration", "unknown_elements")
ONE_DOF = ("Revolute", "Continuous", "Prismatic")
WITH_AXIS = (*ONE_DOF, "Planar")
LEAST_NORMAL = 2.0**-1022  # 6.1.6


def says_same(of_urdf: Any, stated: Any) -> bool:
    """6.1.2: whether a value is the URDF's; numbers agree as in 5.6."""
    if isinstance(of_urdf, dict):
        return isinstance(stated, dict) and all(
            key in stated and says_same(value, stated[key]) for key, value in of_urdf.items()
        )
    if isinstance(of_urdf, list):
        return (
            isinstance(stated, list)
            and len(of_urdf) == len(stated)
            and all(says_same(a, b) for a, b in zip(of_urdf, stated))
        )
    if isinstance(of_urdf, float):
        return stated is not None and agree(of_urdf, stated)
    if isinstance(of_urdf, str):
        return isinstance(stated, str) and line_feeds(of_urdf) == line_feeds(stated)
    return stated is None


def line_feeds(text: str) -> str:
    """6.1.1: a line end may be written as the file has it or as a line feed."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def without(value: dict[str, Any], *keys: str) -> dict[str, Any]:
    return {key: inner for key, inner in value.items() if key not in keys}


def compare(urdd: Urdd, of_urdf: dict[str, Any], stated: dict[str, Any]) -> None:
    """6.1.2: whether the module says what the carried URDF says."""
    error = urdd.report.error
    if not says_same(of_urdf["version"], stated["version"]):
        error("URD001", FILE, "/version")
    if not says_same(of_urdf["materials"], stated["materials"]):
        error("URD014", FILE, "/materials")
    for key in ("name", "unknown_elements"):
        if not says_same(of_urdf[key], stated[key]):
            error("URD013", FILE, "/" + key)
    for kind in ("links", "joints"):
        names = [one["name"] for one in of_urdf[kind]]
        if names != [one["name"] for one in stated[kind]]:
            error("URD001", FILE, "/" + kind)
            return
    for place, (one, other) in enumerate(zip(of_urdf["joints"], stated["joints"])):
        if not all(says_same(one[key], other[key]) for key in OF_JOINT):
            error("URD001", FILE, f"/joints/{place}")
        if not all(says_same(one[key], other[key]) for key in REST_OF_JOINT):
            error("URD013", FILE, f"/joints/{place}")
    for place, (one, other) in enumerate(zip(of_urdf["links"], stated["links"])):
        bare = {**one, "visual": [without(visual, "material") for visual in one["visual"]]}
        if not says_same(bare, other):
            error("URD013", FILE, f"/links/{place}")
        materials = [(a["material"], b["material"]) for a, b in zip(one["visual"], other["visual"])]
        if not all(says_same(a, b) for a, b in materials):
            error("URD014", FILE, f"/links/{place}/visual")


def check_names(urdd: Urdd, robot: dict[str, Any]) -> None:
    """6.1.3."""
    for kind, code in (("links", "URD002"), ("joints", "URD003")):
        names = [one["name"] for one in robot[kind]]
        if len(set(names)) != len(names):
            urdd.report.error(code, FILE, "/" + kind)


def check_tree(urdd: Urdd, robot: dict[str, Any]) -> None:
    """6.1.4."""
    names = {link["name"] for link in robot["links"]}
    below: dict[str, list[str]] = {}
    children: list[str] = []
    for place, joint in enumerate(robot["joints"]):
        parent, child = joint["parent"]["link"], joint["child"]["link"]
        if parent not in names or child not in names:
            urdd.report.error("URD007", FILE, f"/joints/{place}")
        if child in children:
            urdd.report.error("URD005", FILE, f"/joints/{place}/child")
        children.append(child)
        below.setdefault(parent, []).append(child)
    roots = names - set(children)
    if len(roots) != 1:
        urdd.report.error("URD004", FILE, "/links")
    reached: set[str] = set()
    waiting = list(roots)
    while waiting:
        link = waiting.pop()
        if link not in reached:
            reached.add(link)
            waiting += below.get(link, [])
    if names - reached:
        urdd.report.error("URD006", FILE, "/links")


def check_mimics(urdd: Urdd, robot: dict[str, Any]) -> None:
    """6.1.5."""
    by_name = {joint["name"]: joint for joint in robot["joints"]}
    for place, joint in enumerate(robot["joints"]):
        if joint["mimic"] is None or joint["joint_type"] == "Fixed":
            continue
        pointer = f"/joints/{place}/mimic"
        driver = by_name.get(joint["mimic"]["joint"])
        if driver is None:
            urdd.report.error("URD008", FILE, pointer)
            continue
        if joint["joint_type"] not in ONE_DOF or driver["joint_type"] not in (*ONE_DOF, "Fixed"):
            urdd.report.error("URD012", FILE, pointer)
        passed = {joint["name"]}
        while driver and driver["mimic"] and driver["joint_type"] != "Fixed":
            if driver["name"] in passed:
                urdd.report.error("URD009", FILE, pointer)
                break
            passed.add(driver["name"])
            driver = by_name.get(driver["mimic"]["joint"])


def check_axes(urdd: Urdd, robot: dict[str, Any]) -> None:
    """6.1.6."""
    for place, joint in enumerate(robot["joints"]):
        axis = joint["axis"] and joint["axis"]["xyz"]
        if axis and joint["joint_type"] in WITH_AXIS:
            squares = sum(float(part) * float(part) for part in axis)
            if not LEAST_NORMAL <= squares < float("inf"):
                urdd.report.error("URD010", FILE, f"/joints/{place}/axis")


def check_urdf(urdd: Urdd) -> None:
    """6.1."""
    source = urdd.source_text()
    robot = urdd.document("urdf_module")
    if source is not None:
        try:
            of_urdf = read_urdf(source)
        except NotXml:
            urdd.report.error("URD011", urdd.meta["source"]["Urdf"]["path"])
        else:
            if robot:
                compare(urdd, of_urdf, robot)
    if robot:
        check_names(urdd, robot)
        check_tree(urdd, robot)
        check_mimics(urdd, robot)
        check_axes(urdd, robot)
