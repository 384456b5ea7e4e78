"""viser shows the same robot."""

from __future__ import annotations

import sys

import numpy as np
import pytest

import urdd
from sockets import listening


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_links_are_where_they_are(arm: urdd.Robot) -> None:
    shown = arm.show(backend="viser", open_browser=False, port=18765)
    try:
        q = arm.random(seed=8)
        shown.set(q)
        for link, pose in zip(arm.link_names, arm.link_poses(q), strict=True):
            if link in {hull.link for hull in arm.hulls()}:
                np.testing.assert_allclose(shown._frames[link].position, pose[:3, 3], atol=1e-6)
                assert np.linalg.norm(shown._frames[link].wxyz) == pytest.approx(1, abs=1e-6)
    finally:
        shown.close()


@pytest.mark.skipif(sys.platform != "linux", reason="sockets are read from /proc")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_it_listens_to_this_machine_alone(arm: urdd.Robot) -> None:
    before = listening()
    with arm.show(backend="viser", open_browser=False) as shown:
        opened = listening() - before
        assert {("127.0.0.1", shown.server.get_port())} == opened
        assert shown.address == f"http://127.0.0.1:{shown.server.get_port()}"
