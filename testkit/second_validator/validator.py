"""Judging one URDD: the rules in the order in which one presupposes another."""

from __future__ import annotations

import os
import zipfile

from .composition import check_composition
from .derived_meshes import check_derived_meshes
from .derived_rules import check_core
from .directory import META, check_directory
from .documents import read_documents
from .extensions import check_extensions
from .loops import check_loops
from .matrix_rules import check_all_matrices
from .mesh_rules import check_mesh_lists
from .model_rules import check_model
from .modules import TABLE, Urdd
from .original_rules import check_originals
from .report import Report, Unreadable
from .shape_rules import check_shapes
from .spheres import check_spheres
from .tree import Tree, read_archive, read_folder, subtree
from .urdf_rules import check_urdf


def is_root(tree: Tree, folder: str) -> bool:
    """2.14: whether a URDD lies here."""
    prefix = folder + "/" if folder else ""
    return prefix + META in tree.files or any(
        prefix + row[0] in tree.folders for row in TABLE.values()
    )


def open_tree(place: str) -> Tree:
    """2.2, 2.14: the URDD at a place, a folder or a zip archive."""
    if os.path.isdir(place):
        return read_folder(place)
    try:
        with open(place, "rb") as file:
            tree = read_archive(file.read())
    except (OSError, ValueError, zipfile.BadZipFile) as fault:
        raise Unreadable(str(fault)) from fault
    if is_root(tree, ""):
        return tree
    roots = [folder for folder in tree.top() if is_root(tree, folder)]
    if len(roots) != 1:
        raise Unreadable("not one URDD in the archive")
    return subtree(tree, roots[0])


def judge_tree(tree: Tree) -> Report:
    """All rules, on a URDD in memory."""
    urdd = Urdd(tree, Report())
    if check_directory(urdd):
        read_documents(urdd)
        check_urdf(urdd)
        robot = check_core(urdd)
        if robot:
            check_loops(urdd, robot)
        check_composition(urdd)
        check_extensions(urdd)
        check_originals(urdd)
        elements = check_mesh_lists(urdd)
        if elements:
            check_derived_meshes(urdd, elements)
        shapes = check_shapes(urdd)
        if robot and shapes and urdd.report.clean("DOF", "CHN", "BND", "KIN001"):
            check_all_matrices(urdd, robot, shapes)
            check_model(urdd, robot, shapes)
            check_spheres(urdd, robot, shapes)
    return urdd.report


def validate(place: str) -> Report:
    """All rules, on the URDD at a place."""
    return judge_tree(open_tree(place))
