//! Numbers in the clauses of SPEC.md that no rule judges by.

/// Clause, and words of it.
pub const NOT_LIMITS: &[(&str, &str)] = &[
    // Standards and versions.
    ("4.3", "patch, 1.0.1"),
    ("4.3", "minor, 1.1.0"),
    ("4.3", "`dof_module` 1.1.0 with"),
    ("4.3", "major, 2.0.0"),
    ("1.3", "RFC 6901"),
    ("3.1.1", "RFC 8259"),
    ("3.1.1", "IEEE 754 binary64"),
    ("4.2", "version 1.0.0"),
    ("4.4", "urdd` 0.1.0 and 0.2.0* used"),
    ("4.4", "That of 0.1.0 had"),
    ("4.4", "That of 0.2.0 had"),
    ("5.11", "0.0.1: a DOF; 0.0.2: none"),
    ("6.1.8", "by XML 1.0 (fifth edition) and by Namespaces in XML 1.0 (third edition)"),
    ("6.1.9", "it is 1.0."),
    ("7.6", "binary glTF 2.0"),
    ("8.5", "python-fcl 0.7"),
    ("10.1", "module versions 0.0.x"),
    ("10.3", "`bounds_module` 0.0.1"),
    ("10.5", "In `dof_module` 0.0.1 mimic"),
    ("10.8", "`chain_module` 0.0.1 has"),
    ("11.1", "draft 2020-12"),
    // Clauses of this text, which have no number of their own.
    ("3.3.1", "fulfils 3.2."),
    ("11.5", "clauses 6 to 8"),
    // How a writer may write: the canonical emission is one way of several (3.3.1).
    ("3.2.3", "the number 31 to all"),
    ("3.3.3", "From 1e-4 up to, but not including, 1e16"),
    ("3.3.5", "longer than 1,000 characters"),
    ("3.4.1", "longer than 1,000 characters"),
    ("3.4.2", "shift the point from 1e-4 up to 1e16"),
    ("3.4.2", "JavaScript writes 1e16 to 1e21 and 1e-6 to 1e-4"),
    ("3.4.2", "write 0.00001"),
    // Examples and explanations.
    (
        "5.10",
        "With `index` following `thumb` by multiplier 2 and offset 0.25, and `tip` following `index` by 0.5 and -0.5, `tip` is at 0.5 (2 q + 0.25) - 0.5 = q - 0.375: multiplier 1 and offset -0.375 over the DOF of `thumb`. At q = 0.5 `index` is at 1.25, and `tip` at 0.125.",
    ),
    ("5.11", "3 DOFs; see"),
    ("5.11", "SE(3)"),
    ("6.1.6", "at least some 8.6e-155, and at most some 1.3e154"),
    ("6.4.6", "a line of 180 links has paths of 1,976,340 links, one of 181 links 2,009,281"),
    ("7.6.1", "a scale of 0.001 is known to millionths"),
    ("8.5", "within some 3e-6 of that length"),
    ("8.8.11", "z = 1.959963984540054"),
    ("10.3", "this makes [0, 1e-7]"),
    ("13.5", "`num_samples` of 1e9"),
    (
        "9.3",
        "With u = (0.8833108082136426, 0.43152799704850997, 0.026433771592597743) it is (0.29209387643265033, -0.6365225236203906, 0.3185609002678671).",
    ),
    ("7.2", "a box of 1e39 m"),
    (
        "9.1",
        "Some values, for a joint below the root with the origin (0.1, 0.2, 0.3) and rpy (0.1, 0.2, 0.3), and the axis (1, 2, 3) / sqrt 14 where it has one: | joint, q | position of its child link | `quaternion_wxyz` | |---|---|---| | Revolute, 0.5 | (0.1, 0.2, 0.3) | (0.908011430038076, 0.100270090164423, 0.235460482544284, 0.331691894834105) | | Prismatic, 0.3 | (0.183478005928629, 0.367701774310781, 0.534323574185773) | (0.983347443256356, 0.0342707985504821, 0.106020511061796, 0.143572175027392) | | Planar, (0.1, -0.2, 0.5) | (0.270747404701862, 0.060908816006824, 0.338716486448992) | (0.908011430038076, 0.100270090164423, 0.235460482544284, 0.331691894834105) | | Floating, (0.1, -0.2, 0.3, 0.4, 0.5, -0.6) | (0.314153704765969, 0.0265908265353175, 0.553115486079587) | (0.899612587016715, 0.15589694925597, 0.37176039988928, -0.167891451741708) | | Spherical, (0.4, 0.5, -0.6) | (0.1, 0.2, 0.3) | (0.899612587016715, 0.15589694925597, 0.37176039988928, -0.167891451741708) |",
    ),
    // What a producer refuses: no URDD could be right, so no case can be.
    ("7.2", "within 4e-6 of its largest coordinate from one line"),
    // How many numbers an attribute has, which the schema holds.
    ("6.1.8", "`xyz` (3), `rpy` (3), `quat_xyzw` (4)"),
    ("6.1.8", "`scale` (3)"),
    ("6.1.8", "**`size`** (3, finite)"),
    ("6.1.8", "`rgba` (4)"),
    ("6.1.8", "`xyz` (3)"),
    // Said of the same number as another entry of the clause.
    ("8.6", "at most 0.001 m in one of the sampled configurations"),
    ("7.10", "5 % where `surface_tolerance` is null"),
    // Definitions of what is computed. Cases whose values are right hold them.
    ("8.8.3", "sin 2q, cos 2q"),
    ("8.8.11", "Its 95 % interval"),
    ("9.3", "64-bit unsigned"),
    ("9.3", "below 2^32"),
    ("11.4", "sampled configurations (9.3) | 2^32"),
];
