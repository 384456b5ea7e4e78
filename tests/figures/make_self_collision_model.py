"""Writes conformance/vectors/self_collision_model.json: a network with an input of each kind, and what it gives, by numpy
and scipy's rotations; and the intervals of some rates, by scipy.

    python3 tests/figures/make_self_collision_model.py
"""

import json
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation
from scipy.stats import binomtest

TARGET = Path(__file__).parents[2] / "conformance/vectors/self_collision_model.json"


#: A count, and what it is counted among.
RATES = [(0, 1), (1, 1), (0, 300), (9, 903), (35, 5078), (50, 100), (200, 200), (1, 50_000), (49_999, 50_000), (3, 7)]


def interval(count, of):
    """Wilson's score interval: SPEC 8.8.11."""
    found = binomtest(count, of).proportion_ci(0.95, "wilson")
    return {"count": count, "of": of, "lower": float(found.low), "upper": float(found.high)}


def rounded(array):
    return np.round(array, 4).tolist()


def main():
    random = np.random.default_rng(7)
    inputs = [
        {"Angle": {"dof_idx": 4}},
        {"RotationVector": {"dof_idxs": [1, 2, 3]}},
        {"Length": {"dof_idx": 0, "middle": 0.25, "half_range": 0.5}},
    ]
    widths = [14, 5, 4, 3]
    layers = [
        {"weights": rounded(random.normal(size=(b, a))), "biases": rounded(random.normal(size=b))}
        for a, b in zip(widths, widths[1:], strict=False)
    ]
    margins = [0.05, 0.0, -0.125]
    vectors = []
    for k in range(12):
        q = np.round(random.uniform(-3, 3, size=5), 6)
        if k == 0:
            q[:] = 0
        if k == 1:
            q[1:4] = [1e-9, -2e-9, 0]
        a = q[4]
        x = [np.sin(a), np.cos(a), np.sin(2 * a), np.cos(2 * a)]
        x += Rotation.from_rotvec(q[1:4]).as_matrix().ravel().tolist()
        x += [(q[0] - 0.25) / 0.5]
        for place, layer in enumerate(layers):
            if place:
                x = np.tanh(x)
            x = np.array(layer["weights"]) @ np.array(x) + np.array(layer["biases"])
        vectors.append({"configuration": q.tolist(), "clearances": (x - np.array(margins)).tolist()})
    document = {
        "made_by": "tests/figures/make_self_collision_model.py",
        "num_dofs": 5,
        "inputs": inputs,
        "layers": layers,
        "pairs": [
            {"link_a_idx": a, "link_b_idx": b, "margin": margin}
            for (a, b), margin in zip([(0, 2), (0, 3), (1, 3)], margins, strict=True)
        ],
        "vectors": vectors,
        "intervals": [interval(*of) for of in RATES],
    }
    TARGET.write_text(json.dumps(document, indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
