"""A consumer of `self_collision_model_module` in numpy alone: how near the links of a robot are, by its model.

    python3 examples/self_collision_model.py examples_urdd_with_a_model

prints, for each of its test vectors, whether the model clears the configuration and how far its clearances are off."""

import json
import sys
from pathlib import Path

import numpy as np


def told(inputs, q):
    """What the network is told of a configuration q: SPEC 8.8.3."""
    for ((kind, of),) in (entry.items() for entry in inputs):
        if kind == "Angle":
            a = q[of["dof_idx"]]
            yield from (np.sin(a), np.cos(a), np.sin(2 * a), np.cos(2 * a))
        elif kind == "Length":
            yield (q[of["dof_idx"]] - of["middle"]) / of["half_range"]
        else:  # a rotation vector: its matrix, row by row (Rodrigues)
            v = q[of["dof_idxs"]]
            x, angle = np.cross(np.eye(3), -v), np.linalg.norm(v)
            s, c = np.sinc(angle / np.pi), 0.5 * np.sinc(angle / (2 * np.pi)) ** 2
            yield from (np.eye(3) + s * x + c * x @ x).ravel()


def clearances(model, q):
    """The clearance of each of `pairs`, metres: SPEC 8.8.4. One of 0 or less: the pair may be in contact."""
    x = np.array(list(told(model["inputs"], np.asarray(q, float))))
    for place, layer in enumerate(model["layers"]):
        x = np.array(layer["weights"]) @ (np.tanh(x) if place else x) + layer["biases"]
    return x - [pair["margin"] for pair in model["pairs"]]


if __name__ == "__main__":
    folder = Path(sys.argv[1]) / "link_shapes_modules/self_collision_model_module"
    model = json.loads((folder / "module.json").read_text("utf-8"))
    for vector in model["test_vectors"]:
        found = clearances(model, vector["configuration"])
        off = np.abs(found - vector["clearances"]).max()
        print("clears" if (found > 0).all() else "may collide", f"off by {off:.1e} m")
