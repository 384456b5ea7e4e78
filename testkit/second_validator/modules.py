"""The table of modules (12.1), and what a rule may look at."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from .report import Report
from .tree import Tree

MESH = "mesh_modules/"
SHAPE = "link_shapes_modules/"
CLASSES = ("Core", "Geometry", "Shapes")
# name: (folder, class, derived from), in the order of 12.1
TABLE: dict[str, tuple[str, str, tuple[str, ...]]] = {
    "urdf_module": ("urdf_module", "Core", ()),
    "dof_module": ("dof_module", "Core", ("urdf_module",)),
    "chain_module": ("chain_module", "Core", ("urdf_module",)),
    "connections_module": ("connections_module", "Core", ("chain_module",)),
    "bounds_module": ("bounds_module", "Core", ("urdf_module", "dof_module")),
    "kinematics_samples_module": (
        "kinematics_samples_module",
        "",
        ("dof_module", "chain_module", "bounds_module"),
    ),
    "composition_module": ("composition_module", "", ("urdf_module",)),
    "named_configurations_module": (
        "named_configurations_module",
        "",
        ("dof_module", "bounds_module"),
    ),
    "original_meshes_module": (MESH + "original_meshes_module", "Geometry", ("urdf_module",)),
    "plain_meshes_module": (
        MESH + "plain_meshes_module",
        "Geometry",
        ("urdf_module", "original_meshes_module"),
    ),
    "convex_hull_meshes_module": (
        MESH + "convex_hull_meshes_module",
        "Geometry",
        ("plain_meshes_module",),
    ),
    "convex_decomposition_meshes_module": (
        MESH + "convex_decomposition_meshes_module",
        "Geometry",
        ("plain_meshes_module",),
    ),
    "link_shapes_approximations_module": (
        SHAPE + "link_shapes_approximations_module",
        "Shapes",
        ("convex_hull_meshes_module", "convex_decomposition_meshes_module"),
    ),
    "link_shapes_max_distance_from_origin_module": (
        SHAPE + "link_shapes_max_distance_from_origin_module",
        "Shapes",
        (
            "convex_hull_meshes_module",
            "convex_decomposition_meshes_module",
            "link_shapes_approximations_module",
        ),
    ),
    "link_shapes_distance_statistics_module": (
        SHAPE + "link_shapes_distance_statistics_module",
        "Shapes",
        (
            "dof_module",
            "chain_module",
            "bounds_module",
            "convex_hull_meshes_module",
            "convex_decomposition_meshes_module",
            "link_shapes_approximations_module",
        ),
    ),
    "link_shapes_simple_skips_module": (
        SHAPE + "link_shapes_simple_skips_module",
        "Shapes",
        (
            "dof_module",
            "chain_module",
            "bounds_module",
            "convex_hull_meshes_module",
            "convex_decomposition_meshes_module",
            "link_shapes_approximations_module",
            "link_shapes_distance_statistics_module",
        ),
    ),
    "link_shapes_skips_module": (
        SHAPE + "link_shapes_skips_module",
        "Shapes",
        ("urdf_module", "link_shapes_simple_skips_module"),
    ),
    "self_collision_model_module": (
        SHAPE + "self_collision_model_module",
        "",
        (
            "dof_module",
            "chain_module",
            "bounds_module",
            "convex_decomposition_meshes_module",
            "link_shapes_skips_module",
        ),
    ),
    "link_shapes_spheres_module": (
        SHAPE + "link_shapes_spheres_module",
        "",
        (
            "dof_module",
            "chain_module",
            "bounds_module",
            "convex_decomposition_meshes_module",
            "link_shapes_skips_module",
        ),
    ),
    "loops_module": (
        "loops_module",
        "",
        ("urdf_module", "dof_module", "chain_module", "bounds_module"),
    ),
}
LATER = ("link_shapes_spheres_module", "loops_module")  # modules that versions after 1.0 added
ORDER = [name for name in TABLE if name not in LATER]  # 2.6: the others are sorted by name
EXTENSION = re.compile(r"x_[a-z0-9]+_[a-z0-9_]+_module")  # 11.1
VERSION = re.compile(r"(0|[1-9][0-9]{0,8})\.(0|[1-9][0-9]{0,8})\.(0|[1-9][0-9]{0,8})")  # 2.5


def version_of(text: str) -> tuple[int, ...]:
    """A version as numbers that compare."""
    return tuple(int(part) for part in text.split("."))


@dataclass
class Urdd:
    """A URDD while it is judged."""

    tree: Tree
    report: Report
    meta: dict[str, Any] = field(default_factory=dict)
    documents: dict[str, Any] = field(default_factory=dict)
    extensions: list[tuple[str, str]] = field(default_factory=list)

    def document(self, name: str) -> Any:
        """The document of a module that is there and valid under its schema, or None."""
        return self.documents.get(name)

    def have(self, *names: str) -> bool:
        """Whether all of these documents can be judged."""
        return all(name in self.documents for name in names)

    def entries(self) -> list[dict[str, Any]]:
        return self.meta["modules"]

    def source_text(self) -> bytes | None:
        """The carried source, where there is one that can be read."""
        source = self.meta["source"]
        return self.tree.read(source["Urdf"]["path"]) if source else None


def file_of(name: str) -> str:
    """Where the document of a module of the table is."""
    return TABLE[name][0] + "/module.json"
