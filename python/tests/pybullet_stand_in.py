"""What `to_pybullet` asks of PyBullet, which is not installed where the tests run: joints from the URDF, by depth."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.etree import ElementTree

#: Two links on one axis, each of two boxes: those on the axis overlap at all times, the others touch where the tool
#: points back.
MIXED = """<robot name="mixed">
  <link name="base">
    <visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual>
    <visual><origin xyz="0.6 0 0"/><geometry><box size="0.1 0.1 0.2"/></geometry></visual>
  </link>
  <link name="flange"/>
  <link name="tool">
    <visual><geometry><box size="0.1 0.1 0.3"/></geometry></visual>
    <visual><origin xyz="-0.55 0 0"/><geometry><box size="0.1 0.1 0.2"/></geometry></visual>
  </link>
  <joint name="mount" type="fixed"><parent link="base"/><child link="flange"/></joint>
  <joint name="turn" type="revolute"><parent link="flange"/><child link="tool"/><axis xyz="0 0 1"/>
    <limit lower="-3.1" upper="3.1" effort="1" velocity="1"/></joint>
</robot>"""


class StandIn:
    """One body. It records what it received in `filters` and `positions`."""

    URDF_USE_SELF_COLLISION = 8
    URDF_USE_INERTIA_FROM_FILE = 2

    def __init__(self) -> None:
        self.joints: list[tuple[str, str]] = []
        self.filters: dict[tuple[int, int], int] = {}
        self.positions: dict[int, float] = {}

    def loadURDF(self, file: str, **_: Any) -> int:  # noqa: N802
        ends: list[tuple[str, ...]] = []
        for joint in ElementTree.fromstring(Path(file).read_text(encoding="utf-8")).findall("joint"):
            links = [named.get("link", "") for named in (*joint.findall("parent"), *joint.findall("child"))]
            ends.append((joint.get("name", ""), *links))
        waiting = [name for name in {parent for _, parent, _ in ends} if name not in {child for _, _, child in ends}]
        while waiting:
            link = waiting.pop(0)
            below = [(name, child) for name, parent, child in ends if parent == link]
            # As in PyBullet: a link's first child, and all below it, before the second.
            waiting = [child for _, child in below] + waiting
            self.joints += [(name, child) for name, _, child in ends if child == link]
        return 5

    def getNumJoints(self, body: int, **_: Any) -> int:  # noqa: N802
        return len(self.joints)

    def getJointInfo(self, body: int, number: int, **_: Any) -> list[Any]:  # noqa: N802
        found: list[Any] = [number] * 17
        found[1], found[12] = (name.encode() for name in self.joints[number])
        return found

    def setCollisionFilterPair(self, _: int, __: int, a: int, b: int, enable: int, **___: Any) -> None:  # noqa: N802
        self.filters[min(a, b), max(a, b)] = enable

    def resetJointState(self, body: int, number: int, position: float, **_: Any) -> None:  # noqa: N802
        self.positions[number] = position

    def getJointState(self, body: int, number: int, **_: Any) -> tuple[float, ...]:  # noqa: N802
        return (self.positions[number], 0.0)
