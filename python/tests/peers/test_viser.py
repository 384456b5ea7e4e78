"""viser shows the same robot."""

from __future__ import annotations

import numpy as np
import pytest

import urdd


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_links_are_where_they_are(arm: urdd.Robot) -> None:
    shown = arm.show(backend="viser", open_browser=False, port=18765)
    try:
        q = arm.sample(seed=8)
        shown.set(q)
        for link, pose in arm.link_poses(q).items():
            if link in {hull.link for hull in arm.hulls()}:
                np.testing.assert_allclose(shown._frames[link].position, pose[:3, 3], atol=1e-6)
                assert np.linalg.norm(shown._frames[link].wxyz) == pytest.approx(1, abs=1e-6)
    finally:
        shown.close()
