"""Display of a robot: the page of `urdd view`, or viser."""

from __future__ import annotations

from copy import copy
from typing import Any, Literal

from numpy.typing import ArrayLike

from . import _urdd
from ._arrays import one_configuration
from ._kinematics import RobotKinematics
from ._need import need
from ._showing import showing
from ._world import World


class Shown:
    """A robot in the browser, until :meth:`close` is called or Python ends."""

    def __init__(self, robot: RobotKinematics, page: _urdd.Page, address: str) -> None:
        self._robot = robot
        self._page = page
        self._path: ArrayLike | None = None
        self._world: World | None = None
        self.address = address
        """The address to open. It includes the token that the server requires."""

    def set(self, q: ArrayLike) -> None:
        """Shows another configuration (dofs,), in every page that is open. Returns at once: a page that is slower than
        the calls shows the last one."""
        self._page.set(one_configuration(q, self._robot.dof_names)[0].tolist())

    def set_around(self, *, path: ArrayLike | None = None, world: World | None = None) -> None:
        """Shows another path (n, dofs), or other obstacles, in every page that is open. What is not given stays."""
        self._path = self._path if path is None else path
        self._world = self._world if world is None else copy(world)
        text = showing(self._robot.dof_names, path=self._path, world=self._world)
        if text is not None:
            self._page.show(text)

    def close(self) -> None:
        """Stops serving."""
        self._page.close()

    def __enter__(self) -> Shown:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<urdd.Shown at {self.address}>"


class ShownByViser:
    """A robot in viser."""

    def __init__(self, robot: RobotKinematics, server: Any, frames: dict[str, Any]) -> None:
        self._robot = robot
        self._frames = frames
        self.server = server
        """``viser.ViserServer``."""
        self.address: str = f"http://127.0.0.1:{server.get_port()}"
        """The address to open."""

    def set(self, q: ArrayLike) -> None:
        """Shows another configuration (dofs,)."""
        from ._joints import quaternion_of_matrix

        row = one_configuration(q, self._robot.dof_names)[0]
        for link, pose in zip(self._robot.link_names, self._robot.link_poses(row), strict=True):
            if link in self._frames:
                self._frames[link].position = pose[:3, 3]
                self._frames[link].wxyz = quaternion_of_matrix(pose[:3, :3])

    def close(self) -> None:
        """Stops serving."""
        self.server.stop()

    def __enter__(self) -> ShownByViser:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<urdd.ShownByViser at {self.address}>"


class Frame:
    """The page with one robot, for a notebook: the last expression of a cell shows it."""

    def __init__(self, text: str, height: int) -> None:
        self.text = text
        """The page, as HTML."""
        self._height = height

    def _repr_html_(self) -> str:
        # Without `allow-same-origin`, the frame has an origin of its own: its scripts cannot reach the notebook or its
        # server. Users may download the picture and the edits of skips.
        style = f"width: 100%; height: {self._height}px; border: 0"
        import html

        page = html.escape(self.text)
        return f'<iframe sandbox="allow-scripts allow-downloads" style="{style}" srcdoc="{page}"></iframe>'


def show(
    robot: RobotKinematics,
    q: ArrayLike | None,
    *,
    path: ArrayLike | None,
    world: World | None,
    backend: Literal["page", "viser"],
    open_browser: bool,
    port: int | None,
) -> Shown | ShownByViser:
    """As :meth:`urdd.Robot.show`."""
    row = None if q is None else one_configuration(q, robot.dof_names)[0]
    if backend == "page":
        page = _urdd.Page(robot.path, port)
        address = page.address
        if row is not None:
            address += "&q=" + ",".join(repr(value) for value in row.tolist())
        shown = Shown(robot, page, address)
        try:
            shown.set_around(path=path, world=world)
        except BaseException:
            shown.close()
            raise
        if open_browser:
            _open(address)
        return shown
    if backend != "viser":
        raise ValueError(f"unknown backend {backend!r}; expected page or viser")
    if path is not None or world is not None:
        raise ValueError("viser shows the robot alone; the page shows paths and worlds: leave out backend")
    viser = need("viser", "viser", "show(backend='viser')")
    from ._trimesh import link_mesh

    # This machine only: by default viser listens on all interfaces.
    server = viser.ViserServer(host="127.0.0.1", **({} if port is None else {"port": port}))
    frames: dict[str, Any] = {}
    for link, mesh in zip(robot.link_names, robot.modules.plain_meshes.link_meshes, strict=True):
        if mesh is not None:
            frames[link] = server.scene.add_mesh_trimesh(f"/{link}", link_mesh(robot, link))
    by_viser = ShownByViser(robot, server, frames)
    by_viser.set(robot.zero if row is None else row)
    if open_browser:
        _open(by_viser.address)
    return by_viser


def _open(address: str) -> None:
    """Opens a browser at a page that leads to the address, which has a token.

    Everybody on the machine can read the arguments of programs. The page is in a folder that only this user can enter,
    until Python ends.
    """
    import atexit
    import html
    import shutil
    import tempfile
    import webbrowser
    from pathlib import Path

    folder = Path(tempfile.mkdtemp(prefix="urdd-open-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    link = html.escape(address)
    page = folder / "open.html"
    page.touch(mode=0o600)
    page.write_text(
        f'<!doctype html>\n<meta charset="utf-8">\n<title>urdd</title>\n'
        f'<meta http-equiv="refresh" content="0; url={link}">\n<a href="{link}">The robot</a>\n',
        encoding="utf-8",
    )
    webbrowser.open(page.as_uri())


def frame(
    robot: RobotKinematics,
    q: ArrayLike | None,
    path: ArrayLike | None,
    world: World | None,
    height: int,
) -> Frame:
    """As :meth:`urdd.Robot.frame`."""
    return Frame(_urdd.page_html(robot.core, showing(robot.dof_names, q, path, world)), height)
