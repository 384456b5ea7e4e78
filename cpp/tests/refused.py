#!/usr/bin/env python3
"""What would go wrong in silence does not compile, for the reason that is given; what is near it compiles.

    refused.py COMPILER [FLAG...]     flags say where urdd.hpp and Eigen are
"""

from __future__ import annotations

import subprocess
import sys

HEAD = """
#include <urdd.hpp>
#include <urdd/eigen.hpp>
void test(const urdd::Robot &robot, const urdd::Proximity &proximity, std::vector<double> &q, Eigen::MatrixXd &columns,
          Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> &rows, std::size_t tip) {
    (void)robot, (void)proximity, (void)q, (void)columns, (void)rows, (void)tip;
"""
GONE = "the values go at the end of this statement"
STRIDE = "the values are not one after another"
LOST = "results would be written to a temporary"

# A statement, and words of the message; none: it compiles.
CASES = [
    ("auto map = urdd::jacobian_map(robot.jacobian(q, tip)); (void)map;", GONE),
    ("const auto held = robot.jacobian(q, tip); auto map = urdd::jacobian_map(held); (void)map;", None),
    ("Eigen::MatrixXd jacobian = urdd::jacobian(robot, q, tip);", None),
    ("auto map = urdd::pose_map(urdd::identity()); (void)map;", "deleted"),
    ("auto map = urdd::pose_map(robot.link_poses(q)[tip]); (void)map;", "deleted"),
    ("const auto poses = robot.link_poses(q); auto map = urdd::pose_map(poses[tip]); (void)map;", None),
    ("const urdd::Pose &pose = robot.link_poses(q)[tip]; (void)pose;", None),
    ("urdd::Span<const double> span = robot.zero(); (void)span;", GONE),
    ("urdd::Span<const double> span = q; robot.link_poses(span);", None),
    ("robot.link_poses(robot.zero());", None),
    ("urdd::Rows all(robot.random(0, 9), 6); (void)all;", GONE),
    ("urdd::Rows all(q, 6); (void)all;", None),
    ("urdd::Rows all = urdd::rows(Eigen::Matrix<double, -1, -1, Eigen::RowMajor>(rows)); (void)all;", "deleted"),
    ("urdd::Rows all = urdd::rows(columns); (void)all;", "rows of this matrix are not one after another"),
    ("urdd::Rows all = urdd::rows(rows); (void)all;", None),
    ("robot.link_poses(columns.row(0));", STRIDE),
    ("robot.link_poses(columns.topRows(2));", STRIDE),
    ("robot.link_poses(rows.col(0));", STRIDE),
    ("robot.link_poses(Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<>>(q.data(), 3, Eigen::InnerStride<>(2)));", STRIDE),
    ("robot.link_poses(columns.col(0)); robot.link_poses(rows.row(0)); robot.link_poses(columns.col(0).head(6));", None),
    ("Eigen::Matrix<double, 6, -1> j(6, 12); robot.jacobian(q, tip, {0, 0, 0}, j.leftCols(6));", None),
    ("Eigen::Matrix<double, 12, -1> j(12, 6); robot.jacobian(q, tip, {0, 0, 0}, j.topRows(6));", STRIDE),
    ("robot.clamp(robot.random(0));", LOST),
    ("robot.clamp(q); Eigen::VectorXd v(6); robot.clamp(v); robot.clamp(v.head(3));", None),
    ("auto handle = robot.proximity().handle(); (void)handle;", "deleted"),
    ("auto handle = proximity.handle(); (void)handle;", None),
    ("if (robot.covering_checker().in_collision(q)) return;", "CoveringAnswer"),
    ("const bool touches = robot.approximating_checker().in_collision(q); (void)touches;", "ApproximateAnswer"),
    ("if (robot.covering_checker().in_collision(q) == urdd::ApproximateAnswer::free) return;", "ApproximateAnswer"),
    ("urdd::CoveringChecker checker = robot.approximating_checker(); (void)checker;", "error"),
    ("if (robot.covering_checker().in_collision(q) == urdd::CoveringAnswer::free) return;", None),
    ("auto raw = urdd::InverseSettings().raw(); (void)raw;", "deleted"),
    ("urdd::InverseSettings settings; settings.free_of = robot.proximity().handle();", "error"),
    ("urdd::InverseSettings settings; settings.free_of = robot.proximity(); settings.posture = robot.zero();", None),
]


def main() -> int:
    """Compiles each that is refused, and all others at once; 1 where one compiles that must not, or the other way round."""
    allowed = "\n".join(f"    {{ {statement} }}" for statement, words in CASES if words is None)
    cases = [(allowed, None)] + [case for case in CASES if case[1] is not None]
    wrong = 0
    for statement, words in cases:
        text = HEAD + statement + "\n}\n"
        command = [*sys.argv[1:], "-std=c++17", "-fsyntax-only", "-x", "c++", "-"]
        found = subprocess.run(command, input=text, text=True, capture_output=True, check=False)
        is_right = found.returncode == 0 if words is None else found.returncode != 0 and words in found.stderr
        if not is_right:
            wrong += 1
            print(f"{statement}\n  expected {words or 'that it compiles'}, found:\n{found.stderr[:2000]}", file=sys.stderr)
    print(f"refused: {len(cases) - wrong} of {len(cases)} as expected")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
