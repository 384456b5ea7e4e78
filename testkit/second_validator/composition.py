"""The rules of `composition_module` (6.6)."""

from __future__ import annotations

from typing import Any

from .modules import Urdd, file_of

FILE = file_of("composition_module")
POSITIONS = (1, 3, 6)  # 6.6.6


def ascends(values: list[int]) -> bool:
    return values == sorted(set(values))


def indices_exist(document: Any, links: int, joints: int) -> bool:
    """6.6.2."""
    parts = document["parts"]
    link_idxs = [document["base"]["link_idx"]] if document["base"] else []
    joint_idxs: list[int] = []
    part_idxs: list[int] = []
    for part in parts:
        link_idxs += [one["link_idx"] for one in part["links"]]
        joint_idxs += [one["joint_idx"] for one in part["joints"] + part["frozen_joints"]]
        attachment = part["attachment"]
        if attachment:
            link_idxs.append(attachment["link_idx"])
            joint_idxs.append(attachment["joint_idx"])
            if attachment["part_idx"] is not None:
                part_idxs.append(attachment["part_idx"])
    return (
        all(one < links for one in link_idxs)
        and all(one < joints for one in joint_idxs)
        and all(one < len(parts) for one in part_idxs)
    )


def check_ownership(urdd: Urdd, document: Any, links: int, joints: int) -> None:
    """6.6.3: each link and joint in one place."""
    of_links = [document["base"]["link_idx"]] if document["base"] else []
    of_joints: list[int] = []
    for place, part in enumerate(document["parts"]):
        own_links = [one["link_idx"] for one in part["links"]]
        own_joints = [one["joint_idx"] for one in part["joints"]]
        names = [one["name"] for one in part["links"]] + part["dropped_links"]
        joint_names = [one["name"] for one in part["joints"]] + part["dropped_joints"]
        unique = len(set(names)) == len(names) and len(set(joint_names)) == len(joint_names)
        if not (ascends(own_links) and ascends(own_joints) and unique):
            urdd.report.error("CMP003", FILE, f"/parts/{place}")
        of_links += own_links
        of_joints += own_joints
        if part["attachment"]:
            of_joints.append(part["attachment"]["joint_idx"])
    if sorted(of_links) != list(range(links)) or sorted(of_joints) != list(range(joints)):
        urdd.report.error("CMP003", FILE, "/parts")


def check_attachments(urdd: Urdd, document: Any, robot: Any) -> None:
    """6.6.5."""
    parts = document["parts"]
    place_of = {link["name"]: place for place, link in enumerate(robot["links"])}
    ends = [
        (place_of.get(joint["parent"]["link"]), place_of.get(joint["child"]["link"]))
        for joint in robot["joints"]
    ]
    owned = [{one["link_idx"] for one in part["links"]} for part in parts]
    for place, part in enumerate(parts):
        inside = all(set(ends[one["joint_idx"]]) <= owned[place] for one in part["joints"])
        attachment = part["attachment"]
        if attachment:
            parent, child = ends[attachment["joint_idx"]]
            inside = inside and parent == attachment["link_idx"] and child in owned[place]
            other = attachment["part_idx"]
            base = document["base"] and document["base"]["link_idx"]
            inside = inside and (parent in owned[other] if other is not None else parent == base)
        if not inside:
            urdd.report.error("CMP005", FILE, f"/parts/{place}")
    attached = len([part for part in parts if part["attachment"]])
    if attached != len(parts) - (0 if document["base"] else 1):
        urdd.report.error("CMP005", FILE, "/parts")


def check_frozen(urdd: Urdd, part: Any, place: int, robot: Any) -> None:
    """6.6.6."""
    own = [one["joint_idx"] for one in part["joints"]]
    frozen = [one["joint_idx"] for one in part["frozen_joints"]]
    fixed = all(robot["joints"][joint]["joint_type"] == "Fixed" for joint in frozen)
    lengths = all(len(one["position"]) in POSITIONS for one in part["frozen_joints"])
    if not (ascends(frozen) and set(frozen) <= set(own) and fixed and lengths):
        urdd.report.error("CMP006", FILE, f"/parts/{place}/frozen_joints")


def check_composition(urdd: Urdd) -> None:
    """6.6."""
    if not urdd.have("urdf_module", "composition_module") or not urdd.report.clean("URD"):
        return
    document, robot = urdd.documents["composition_module"], urdd.documents["urdf_module"]
    if not indices_exist(document, len(robot["links"]), len(robot["joints"])):
        urdd.report.error("CMP001", FILE, "/parts")
        return
    ids = [part["id"] for part in document["parts"]]
    if len(set(ids)) != len(ids) or not all(one and "/" not in one for one in ids):
        urdd.report.error("CMP002", FILE, "/parts")  # 6.6.2
    check_ownership(urdd, document, len(robot["links"]), len(robot["joints"]))
    check_attachments(urdd, document, robot)
    for place, part in enumerate(document["parts"]):
        check_frozen(urdd, part, place, robot)
        pairs = [(one["name"], robot["links"][one["link_idx"]]["name"]) for one in part["links"]]
        pairs += [
            (one["name"], robot["joints"][one["joint_idx"]]["name"]) for one in part["joints"]
        ]
        if any(part["prefix"] + name != whole for name, whole in pairs):
            urdd.report.error("CMP004", FILE, f"/parts/{place}")  # 6.6.4
