"""Rules about the files that a URDF names."""
from model import *


def named_files(robot):
    for link, kind, index, element, shape in robot.meshes():
        yield where("link", link.name), kind, shape.get("filename")
    for element in robot.xml.iter("texture"):
        if element.get("filename"):
            yield where("material", element.getparent().get("name", "")), "texture", element.get("filename")


def once(findings):
    """The first finding of each (element, file)."""
    seen = set()
    for element, key, message, data in findings:
        if key not in seen:
            seen.add(key)
            yield element, message, data


@rule("LNT023", "mirrored-scale")
def mirrored_scale(robot):
    """`scale` with a zero, or with an odd number of negative factors."""
    for link, kind, index, element, shape in robot.meshes():
        scale = numbers(shape.get("scale"), 3)
        if scale and min(scale) == 0 or scale and 0 in scale:
            yield where("link", link.name), f"{kind} {index}: scale {shape.get('scale')} flattens the mesh", {"scale": scale, "kind": kind}
        elif scale and np.prod(scale) < 0:
            yield where("link", link.name), f"{kind} {index}: scale {shape.get('scale')} mirrors the mesh, so its faces point inward", {"scale": scale, "kind": kind}


@rule("LNT026", "absolute-path")
def absolute_path(robot):
    """A file named by an absolute path (/..., file:///..., C:...), or by `file://` and a relative one."""
    def findings():
        for element, kind, name in named_files(robot):
            if re.match(r"file://[^/]", name):
                yield element, name, f"in `{name}`, `{name[7:].split('/')[0]}` is the name of a computer: `file://` is followed by an absolute path", {"name": name, "kind": "host"}
            elif re.match(r"(file:/*)?(/|[A-Za-z]:[\\/])", name):
                yield element, name, f"`{name}` is an absolute path", {"name": name, "kind": "absolute"}
    yield from once(findings())


@rule("LNT027", "backslash-in-path")
def backslash_in_path(robot):
    """A backslash in a file's name."""
    yield from once((element, name, f"`{name}` has a backslash, which only Windows takes as a separator", {"name": name})
                    for element, kind, name in named_files(robot) if "\\" in name)


def other_case(robot, name):
    """The file that `name` would be in another case, or None."""
    match = re.match(r"(package|model)://([^/]*)/?(.*)\Z", name)
    if match:
        starts = []
        for folder in robot.path.parents:
            if folder.name.lower() == match.group(2).lower():
                starts.append(folder)
            elif folder.is_dir():
                starts += [f for f in folder.iterdir() if f.name.lower() == match.group(2).lower() and f.is_dir()]
            if robot.root and folder == robot.root:
                break
        rest = match.group(3)
    else:
        if name.startswith("file://") or name.startswith("/"):
            return None
        starts, rest = [robot.path.parent], name
    for at in starts:
        for part in Path(rest).parts:
            if part == "..":
                at = at.parent
                continue
            options = [f for f in at.iterdir() if f.name == part] if at.is_dir() else []
            options = options or ([f for f in at.iterdir() if f.name.lower() == part.lower()] if at.is_dir() else [])
            if not options:
                at = None
                break
            at = options[0]
        if at is not None and at.is_file():
            return at
    return None


@rule("LNT028", "letter-case")
def letter_case(robot):
    """A file that is not there, but is in another case."""
    def findings():
        for element, kind, name in named_files(robot):
            if robot.find(name)[0] is None:
                other = other_case(robot, name)
                if other:
                    yield element, name, f"`{name}` is not there, but `{other.name}` is in another case", {"name": name, "other": str(other)}
    yield from once(findings())


def seen_from_above(robot, name):
    """The nearest folder above the URDF from which the relative `name` is found, or None."""
    for folder in robot.path.parent.parents:
        if (folder / name).is_file():
            return folder
        if robot.root and folder == robot.root:
            return None
    return None


@rule("LNT029", "mesh-not-found")
def mesh_not_found(robot):
    """A mesh that is not there in any case, in a package that is there or relative to the URDF."""
    def findings():
        for link, kind, index, element, shape in robot.meshes():
            name = shape.get("filename")
            path, why = robot.find(name)
            if path is not None or why != "file-not-found" or "\\" in name or re.match(r"(file:/*)?(/|[A-Za-z]:[\\/])", name) or other_case(robot, name):
                continue
            above = None if "://" in name else seen_from_above(robot, name)
            if above:
                yield where("link", link.name), name, f"`{name}` is not there from the URDF's folder, only from `{above.name}` above it", {"kind": "above", "name": name}
            else:
                yield where("link", link.name), name, f"`{name}` is not there", {"kind": "missing", "name": name}
    yield from once(findings())


@rule("LNT037", "package-not-found")
def package_not_found(robot):
    """A package that no folder above the URDF is or holds (it may be installed elsewhere)."""
    def findings():
        for element, kind, name in named_files(robot):
            if robot.find(name) == (None, "package-not-found") and other_case(robot, name) is None:
                package = name.split("/")[2]
                yield "robot", package, f"package `{package}` is not found above the URDF", {"package": package}
    yield from once(findings())


@rule("LNT032", "mesh-names-clash")
def mesh_names_clash(robot):
    """Two collision meshes of one file name in different folders, with different contents: MuJoCo before 4.0, which strips the
    folders, takes one for both. (It discards visuals.)"""
    names = {}
    for link, kind, index, element, shape in robot.meshes("collision"):
        path, _ = robot.find(shape.get("filename"))
        if path is not None:
            names.setdefault(path.name, {}).setdefault(path, (link.name, shape.get("filename")))
    for name, paths in names.items():
        contents = {p.read_bytes(): p for p in paths}
        if len(contents) > 1:
            first, second = list(contents.values())[:2]
            yield where("link", paths[second][0]), f"`{paths[first][1]}` and `{paths[second][1]}` have one file name: MuJoCo before 4.0 takes one for both", {
                "names": [str(p) for p in contents.values()]}


@rule("LNT033", "size-not-positive")
def size_not_positive(robot):
    """A collision box, cylinder, sphere or capsule with a size of 0 or less."""
    for link, kind, index, element, shape in robot.geometries():
        what = tag(shape)
        sizes = {"box": lambda: numbers(shape.get("size"), 3), "sphere": lambda: numbers(shape.get("radius"), 1)}.get(
            what, lambda: (numbers(shape.get("radius"), 1) or []) + (numbers(shape.get("length"), 1) or []))()
        if kind == "collision" and what != "mesh" and sizes and min(sizes) <= 0:
            yield where("link", link.name), f"{kind} {index}: {what} has a size of {min(sizes):g}", {"kind": kind, "shape": what}


@rule("LNT007", "root-link-with-inertial")
def root_link_with_inertial(robot):
    """The root has joints below it and an inertial with mass: KDL leaves it out."""
    for name in robot.roots:
        link = robot.links[name]
        if len(robot.roots) == 1 and link.mass and len(robot.links) > 1:
            yield where("link", name), "the root link has an inertial, which KDL leaves out", {"mass": link.mass}


@rule("LNT006", "moving-link-without-inertial")
def moving_link_without_inertial(robot):
    """A body below a joint that moves, none of whose links has a mass above 0. Once for a robot without any mass."""
    if not any(link.mass for link in robot.links.values()):
        if any(j.type in MOVING for j in robot.joints.values()):
            yield "robot", "no link has a mass", {"kind": "none"}
        return
    for top, members in robot.bodies().items():
        joint = robot.above.get(top)
        if joint is not None and joint.type in MOVING and not any(robot.links[n].mass for n, _ in members):
            geometry = any(robot.links[n].visuals or robot.links[n].collisions for n, _ in members)
            yield where("link", top), f"{joint.type} joint `{joint.name}` moves it, and it has no mass", {"kind": "geometry" if geometry else "bare",
                                                                                                       "inertial": any(robot.links[n].inertial is not None for n, _ in members)}
