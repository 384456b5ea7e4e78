"""The rules of `self_collision_model_module` that do not count configurations (8.8).

LRN010 and LRN011 count 100,000 configurations, which takes more work than this validator is
willing to do (8.8.9, 13.4): a model is *not verified* here.
"""

from __future__ import annotations

import hashlib
import math
from typing import Any

from .kinematics import Robot
from .modules import Urdd, file_of
from .numeric import from_rotation_vector
from .shape_rules import Shapes

NAME = "self_collision_model_module"
FILE = file_of(NAME)
MAX_PARAMETERS = 65_536  # 8.8.4
MAX_VECTORS = 100  # 8.8.4
NUM_EVALUATED = 50_000  # 8.8.9
FIRST_EVALUATED = 2**31  # 8.8.8
LEAST_OF_EACH = 200  # 8.8.9
RELATIVE = 1e-9  # 8.8.6
INPUT_VALUES = {"Angle": 4, "Length": 1, "RotationVector": 9}  # 8.8.3


def input_of(entry: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    return next((kind, entry[kind]) for kind in INPUT_VALUES if kind in entry)


def dofs_of(entry: dict[str, Any]) -> list[int]:
    _, inside = input_of(entry)
    return inside["dof_idxs"] if "dof_idxs" in inside else [inside["dof_idx"]]


def check_indices(urdd: Urdd, model: Any, robot: Robot) -> None:
    """8.8.2."""
    dofs = [dof for entry in model["inputs"] for dof in dofs_of(entry)]
    if any(dof >= len(robot.dof_joint) for dof in dofs):
        urdd.report.error("LRN001", FILE, "/inputs")
    lists = []
    for key in ("pairs", "other_pairs"):
        pairs = [(pair["link_a_idx"], pair["link_b_idx"]) for pair in model[key]]
        if pairs != sorted(set(pairs)) or not all(a < b < len(robot.links) for a, b in pairs):
            urdd.report.error("LRN001", FILE, "/" + key)
        lists += pairs
    if len(set(lists)) != len(lists):
        urdd.report.error("LRN001", FILE, "/other_pairs")


def check_inputs(urdd: Urdd, model: Any, robot: Robot) -> None:
    """8.8.3."""
    firsts = robot.rotation_vectors()
    in_vectors = {first + n for first in firsts for n in range(3)}
    taken: list[int] = []
    for place, entry in enumerate(model["inputs"]):
        kind, inside = input_of(entry)
        dofs = dofs_of(entry)
        taken += dofs
        if kind == "RotationVector":
            right = dofs[0] in firsts and dofs == [dofs[0], dofs[0] + 1, dofs[0] + 2]
        elif kind == "Length":
            right = robot.is_length(dofs[0]) and inside["half_range"] > 0
        else:
            right = not robot.is_length(dofs[0]) and dofs[0] not in in_vectors
        if not right:
            urdd.report.error("LRN002", FILE, f"/inputs/{place}")
    if len(set(taken)) != len(taken):
        urdd.report.error("LRN002", FILE, "/inputs")


def lengths_follow(model: Any, robot: Robot) -> bool:
    """8.8.4."""
    before = sum(INPUT_VALUES[input_of(entry)[0]] for entry in model["inputs"])
    if before < 1 or not model["layers"]:
        return False
    for layer in model["layers"]:
        rows = layer["weights"]
        if len(rows) != len(layer["biases"]) or any(len(row) != before for row in rows):
            return False
        before = len(rows)
        if before < 1:
            return False
    vectors = model["test_vectors"]
    return (
        before == len(model["pairs"])
        and len(vectors) > 0
        and all(
            len(one["configuration"]) == len(robot.dof_joint) and len(one["clearances"]) == before
            for one in vectors
        )
    )


def overflows(model: Any, robot: Robot) -> bool:
    """8.8.4."""
    largest: list[float] = []
    for entry in model["inputs"]:
        kind, inside = input_of(entry)
        if kind == "Length":
            bounds = robot.bounds(inside["dof_idx"])
            ends = [abs((q - inside["middle"]) / inside["half_range"]) for q in bounds]
            largest.append(max(ends))
        else:
            largest += [1.0] * INPUT_VALUES[kind]
    for layer in model["layers"]:
        for row, bias in zip(layer["weights"], layer["biases"]):
            total = abs(bias) + sum(abs(weight) * most for weight, most in zip(row, largest))
            if not math.isfinite(total):
                return True
        largest = [1.0] * len(layer["biases"])
    return False


def clearances(model: Any, q: list[float]) -> list[float]:
    """8.8.3, 8.8.4: what the network gives."""
    values: list[float] = []
    for entry in model["inputs"]:
        kind, inside = input_of(entry)
        dofs = dofs_of(entry)
        if kind == "Angle":
            angle = q[dofs[0]]
            values += [math.sin(angle), math.cos(angle), math.sin(2 * angle), math.cos(2 * angle)]
        elif kind == "Length":
            values.append((q[dofs[0]] - inside["middle"]) / inside["half_range"])
        else:
            rotation = from_rotation_vector([q[dof] for dof in dofs])
            values += [part for row in rotation for part in row]
    for place, layer in enumerate(model["layers"]):
        rows = zip(layer["weights"], layer["biases"])
        values = [sum(w * v for w, v in zip(row, values)) + bias for row, bias in rows]
        if place < len(model["layers"]) - 1:
            values = [math.tanh(value) for value in values]
    return [value - pair["margin"] for value, pair in zip(values, model["pairs"])]


def digest(urdd: Urdd) -> str:
    """8.8.7."""
    names = ("dof_module", "chain_module", "bounds_module", "link_shapes_skips_module")
    paths = [file_of(name) for name in names]
    pieces = urdd.documents["convex_decomposition_meshes_module"]["link_pieces"]
    paths += [piece["glb"] for of_link in pieces for piece in of_link]
    lines = [hashlib.sha256(urdd.tree.data(path)).hexdigest() + "\n" for path in paths]
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def unskipped(urdd: Urdd, shapes: Shapes) -> set[tuple[int, int]]:
    """8.8.5: the pairs of links that are not skipped."""
    document = urdd.documents["link_shapes_skips_module"]
    skips = document["decomposition_convex_hulls_skips"]
    links = [link for link, _ in shapes.pieces]
    if skips is None:
        skips, links = document["full_convex_hulls_skips"], shapes.full
    found = set()
    for i, a in enumerate(links):
        for j, b in enumerate(links):
            if a < b and not skips[i][j]:
                found.add((a, b))
    return found


def counts_possible(model: Any) -> bool:
    """8.8.8."""
    ranges = []
    for key in ("training", "calibration"):
        start, count = model[key]["first_sample_idx"], model[key]["num_configurations"]
        if count < 1 or start + count > FIRST_EVALUATED:
            return False
        ranges.append((start, start + count))
    (a, b), (c, d) = ranges
    if a < d and c < b:
        return False
    e = model["evaluation"]
    return (
        e["num_missed"] <= e["num_colliding"]
        and e["num_near_contact"] <= e["num_colliding"]
        and e["num_near_contact_missed"] <= e["num_near_contact"]
        and e["num_near_contact_missed"] <= e["num_missed"]
        and e["num_cleared"] <= e["num_free"]
        and e["num_colliding"] + e["num_free"] == NUM_EVALUATED
    )


def check_numbers(urdd: Urdd, model: Any, robot: Robot) -> None:
    """8.8.4, 8.8.6: what the network may be, and what it gives."""
    error = urdd.report.error
    if not lengths_follow(model, robot):
        error("LRN003", FILE, "/layers")
        return
    if overflows(model, robot):
        error("LRN004", FILE, "/layers")
        return
    sizes = [
        len(layer["biases"]) + sum(len(row) for row in layer["weights"])
        for layer in model["layers"]
    ]
    if sum(sizes) > MAX_PARAMETERS or len(model["test_vectors"]) > MAX_VECTORS:
        error("LRN005", FILE, "/layers")
    for place, vector in enumerate(model["test_vectors"]):
        for one, other in zip(clearances(model, vector["configuration"]), vector["clearances"]):
            if abs(one - other) > RELATIVE * max(abs(one), abs(other), model["clip_distance"]):
                error("LRN008", FILE, f"/test_vectors/{place}/clearances")


def check_model(urdd: Urdd, robot: Robot, shapes: Shapes) -> None:
    """8.8."""
    if not urdd.have(NAME, "link_shapes_skips_module") or not urdd.report.clean("SHP"):
        return
    model = urdd.documents[NAME]
    error = urdd.report.error
    check_indices(urdd, model, robot)
    if not urdd.report.clean("LRN"):
        return
    check_inputs(urdd, model, robot)
    if urdd.report.clean("LRN"):
        check_numbers(urdd, model, robot)
    if model["trained_on"] != digest(urdd):
        error("LRN006", FILE, "/trained_on")
    pairs = {
        (pair["link_a_idx"], pair["link_b_idx"]) for pair in model["pairs"] + model["other_pairs"]
    }
    if pairs != unskipped(urdd, shapes):
        error("LRN007", FILE, "/pairs")
    if not counts_possible(model):
        error("LRN009", FILE, "/evaluation")
    elif min(model["evaluation"]["num_colliding"], model["evaluation"]["num_free"]) < LEAST_OF_EACH:
        error("LRN012", FILE, "/evaluation")
