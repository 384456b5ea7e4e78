"""What people, and programs that write URDFs, put into an attribute by mistake, by the kind of value.

Each function yields (label, text, meaning): `text` replaces the value as it stands in the file, `meaning` is what a
person means by it, where that is another value than before; None is "the value that was there".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

Variant = tuple[str, str, str | None]
LONG = "0.1000000000000000055511151231257827021181583404541015625"


def as_written(label: str, text: str) -> Variant:
    return label, text, text


def plain(value: float) -> str:
    return f"{value:.12g}"


def spaced(value: str) -> Iterator[Variant]:
    yield "empty", "", None
    yield "spaces", "  ", None
    yield "leading_space", f" {value}", None
    yield "trailing_space", f"{value} ", None
    yield "leading_tab", f"\t{value}", None
    yield "trailing_tab", f"{value}\t", None
    yield "leading_newline", f"\n{value}", None
    yield "trailing_newline", f"{value}\n", None
    yield "trailing_newline_reference", f"{value}&#10;", None
    yield "leading_newline_reference", f"&#10;{value}", None
    yield "trailing_tab_reference", f"{value}&#x9;", None
    yield "trailing_return_reference", f"{value}&#13;", None
    yield "no_break_space", f"{value}&#160;", None
    yield "no_break_space_raw", f"{value}\u00a0", None


def number_like(value: str) -> Iterator[Variant]:
    """What is no plain decimal number, or one that is written in a less usual way."""
    yield "text", "abc", None
    yield "text_after", f"{value} x", None
    yield "letter_after", f"{value}x", None
    yield "nan", "nan", None
    yield "NaN", "NaN", None
    yield "negative_nan", "-nan", None
    yield "inf", "inf", None
    yield "negative_inf", "-inf", None
    yield "Infinity", "Infinity", None
    yield "dot_inf", ".inf", None
    yield "one_inf", "1.#INF", None
    yield "plus", f"+{value}", None
    yield as_written("one_dot", "1.")
    yield as_written("dot_five", ".5")
    yield as_written("exponent", "1e-1")
    yield as_written("exponent_upper", "1E-1")
    yield as_written("exponent_plus", "1e+0")
    yield "exponent_huge", "1e400", None
    yield "exponent_float_huge", "1e39", "1e39"
    yield "exponent_tiny", "1e-400", "0"
    yield "exponent_subnormal", "1e-310", "1e-310"
    yield "exponent_float_tiny", "1e-42", "1e-42"
    yield "exponent_d", "1d0", None
    yield "exponent_open", "1e", None
    yield "exponent_alone", "e5", None
    yield "exponent_space", "1 e0", None
    yield "hexadecimal", "0x1", None
    yield "hexadecimal_float", "0x1p-1", None
    yield "octal", "010", "10"
    yield "comma", (value if "." in value else f"{value}.5").replace(".", ","), None
    yield "thousands", "1,000", None
    yield "underscore", "1_0", None
    yield "unit", f"{value}m", None
    yield "unit_space", f"{value} m", None
    yield "degree", f"{value}°", None
    yield "fraction", "1/2", None
    yield "pi", "pi", None
    yield "expression", "${pi/2}", None
    yield "substitution", "$(arg x)", None
    yield "two_dots", "1.2.3", None
    yield "dot_alone", ".", None
    yield "sign_alone", "-", None
    yield "two_signs", f"--{value.lstrip('-')}", None
    yield "sign_space", f"- {value.lstrip('-')}", None
    yield "minus_unicode", f"\u2212{value.lstrip('-')}", None
    yield "digits_unicode", "\u0661", None
    yield as_written("long", LONG)
    yield as_written("very_long", LONG + "0" * 300)
    yield as_written("many_zeros", "0" * 300 + "1")
    yield as_written("leading_zero", "00.5")
    yield "true", "true", None
    yield "false", "false", None
    yield "two_values", f"{value} {value}", None
    yield "two_values_comma", f"{value},{value}", None
    yield "quoted", f"&quot;{value}&quot;", None
    yield "bracketed", f"[{value}]", None
    yield "semicolon", f"{value};", None
    yield "f_suffix", f"{value}f", None
    yield "reference", f"&#{ord(value[0])};{value[1:]}", None
    yield "reference_hexadecimal", f"&#x{ord(value[0]):x};{value[1:]}", None
    yield "null_word", "null", None
    yield "none_word", "None", None


def number(value: str) -> Iterator[Variant]:
    yield from spaced(value)
    yield from number_like(value)
    yield as_written("negative", value[1:] if value.startswith("-") else f"-{value}")
    yield as_written("zero", "0")
    yield as_written("negative_zero", "-0")
    yield as_written("tiny", "1e-12")
    yield as_written("large", "1e9")
    yield as_written("double", plain(2 * float(value)))


def vector(value: str) -> Iterator[Variant]:
    yield from spaced(value)
    parts = value.split()
    middle = len(parts) // 2
    yield "too_few", " ".join(parts[:-1]), None
    yield "one", parts[0], None
    yield "two", " ".join(parts[:2]), None
    yield "too_many", f"{value} 0", None
    yield "twice", f"{value} {value}", None
    yield "too_many_text", f"{value} x", None
    yield "commas", ",".join(parts), None
    yield "commas_spaces", ", ".join(parts), None
    yield "semicolons", "; ".join(parts), None
    yield "double_spaces", "  ".join(parts), None
    yield "tabs", "\t".join(parts), None
    yield "newlines", "\n".join(parts), None
    yield "returns", "\r\n".join(parts), None
    yield "newline_references", "&#10;".join(parts), None
    yield "tab_references", "&#9;".join(parts), None
    yield "space_references", "&#32;".join(parts), None
    yield "no_break_spaces", "\u00a0".join(parts), None
    yield "indented", ("\n        ").join(["", *parts, ""]), None
    yield "bracketed", f"[{value}]", None
    yield "tuple", "(" + ", ".join(parts) + ")", None
    yield as_written("zeros", " ".join("0" for _ in parts))
    yield as_written("negatives", " ".join(plain(-float(part)) for part in parts))
    yield as_written("large", " ".join("1e9" for _ in parts))
    for where, i in (("first", 0), ("middle", middle), ("last", len(parts) - 1)):
        for label, text, meaning in [*number_like(parts[i]), as_written("zero", "0"), as_written("negative", "-0.5")]:
            mean = None if meaning is None else " ".join([*parts[:i], meaning, *parts[i + 1 :]])
            yield f"{where}_{label}", " ".join([*parts[:i], text, *parts[i + 1 :]]), mean


def rgba(value: str) -> Iterator[Variant]:
    yield from vector(value)
    yield "bytes", "255 128 0 255", None
    yield as_written("above_one", "1.5 0.5 0.5 1")
    yield as_written("transparent", "0.5 0.5 0.5 0")
    yield "hash", "#ff8000", None


def name(value: str) -> Iterator[Variant]:
    """Another name at one place alone: what refers to it no longer does."""
    yield from spaced(value)
    yield "upper", value.upper(), None
    yield "other", f"{value}_2", None
    yield "space", f"{value} x", None
    yield "reference", f"&#{ord(value[0])};{value[1:]}", None


def new_name(value: str) -> Iterator[Variant]:
    """Another name, wherever the name stands."""
    yield as_written("space", f"{value} x")
    yield as_written("leading_space", f" {value}")
    yield as_written("trailing_space", f"{value} ")
    yield as_written("two_spaces", f"{value}  x")
    yield as_written("slash", f"{value}/x")
    yield as_written("leading_slash", f"/{value}")
    yield as_written("trailing_slash", f"{value}/")
    yield as_written("colons", f"{value}::x")
    yield as_written("colon", f"{value}:x")
    yield as_written("dot", f"{value}.x")
    yield as_written("hyphen", f"{value}-x")
    yield as_written("unicode", f"{value}_größe")
    yield as_written("emoji", f"{value}\U0001f916")
    yield as_written("digits", "123")
    yield as_written("leading_digit", f"1{value}")
    yield as_written("world", "world")
    yield as_written("root", "root")
    yield as_written("keyword", "default")
    yield as_written("double_underscore", f"__{value}__")
    yield as_written("empty", "")
    yield as_written("one_space", " ")
    yield as_written("long", value + "x" * 300)
    yield as_written("very_long", value + "x" * 1100)
    yield as_written("ampersand", f"{value}&amp;x")
    yield as_written("less", f"{value}&lt;x")
    yield as_written("quote", f"{value}&quot;x")
    yield as_written("brackets", f"{value}[0]")
    yield as_written("braces", f"{value}{{x}}")
    yield as_written("percent", f"{value}%20x")
    yield as_written("percent_s", f"{value}%s%n")
    yield as_written("backslash", f"{value}\\x")
    yield as_written("hash", f"{value}#x")
    yield as_written("at", f"{value}@x")
    yield as_written("star", f"{value}*")
    yield as_written("newline", f"{value}&#10;x")
    yield as_written("tab", f"{value}&#9;x")


JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")


def joint_type(value: str) -> Iterator[Variant]:
    yield from spaced(value)
    for other in JOINT_TYPES:
        if other != value:
            yield as_written(other, other)
    yield as_written("spherical", "spherical")
    yield as_written("ball", "ball")
    yield as_written("screw", "screw")
    yield as_written("universal", "universal")
    yield "upper", value.upper(), None
    yield "capitalised", value.capitalize(), None
    yield "misspelt", value[:-2] + value[-1], None
    yield "longer", f"{value}s", None
    yield as_written("hinge", "hinge")
    yield as_written("unknown", "unknown")
    yield "number", "1", None


MESHES = (
    "part.stl", "ascii.stl", "solid.stl", "upper.STL", "part.obj", "plain.obj", "part.dae", "part_cm_y.dae",
    "part.glb", "part.gltf", "part.ply", "part", "part.xyz", "with space.stl", "größe.stl", "folder/inside.stl",
    "folder/part.stl", "empty.stl", "empty.obj", "odd.stl", "odd.obj", "odd.dae", "no_scene.dae", "no_asset.dae",
    "no_place.dae", "short.stl", "long.stl",
    "no_faces.stl", "no_faces.obj", "no_faces_ascii.stl", "flat.stl", "open.stl", "one.stl", "no_material.obj",
    "really_obj.stl", "really_stl.obj", "missing.stl", "missing.obj", "missing.dae", "folder",
)  # fmt: skip


def filename(value: str) -> Iterator[Variant]:
    yield from spaced(value)
    last = value.rsplit("/", 1)[-1]
    stem, _, extension = last.rpartition(".")
    for mesh in MESHES:
        if mesh != value:
            yield as_written(f"file_{mesh}", mesh)
    for label, text in (
        ("package", "package://part_description/meshes/part.stl"),
        ("package_unknown", "package://nowhere_description/meshes/part.stl"),
        ("package_missing", "package://part_description/meshes/missing.stl"),
        ("package_alone", "package://part_description"),
        ("package_empty", "package://"),
        ("package_three_slashes", "package:///part_description/meshes/part.stl"),
        ("package_one_slash", "package:/part_description/meshes/part.stl"),
        ("package_upper", "PACKAGE://part_description/meshes/part.stl"),
        ("package_up", "package://part_description/../part_description/meshes/part.stl"),
        ("package_double_slash", "package://part_description//meshes/part.stl"),
        ("model", "model://part_description/meshes/part.stl"),
        ("find", "$(find part_description)/meshes/part.stl"),
        ("file_relative", f"file://{last}"),
        ("file_absolute_missing", f"file:///nowhere/{last}"),
        ("absolute_missing", f"/nowhere/{last}"),
        ("http", f"http://localhost:1/{last}"),
        ("leading_slash", f"/{last}"),
        ("file_leading_slash", f"file:///{last}"),
        ("windows", f"C:\\nowhere\\{last}"),
        ("backslash", "folder\\part.stl"),
        ("dot_slash", f"./{last}"),
        ("dot_backslash", f".\\{last}"),
        ("up", f"../base/{last}"),
        ("up_and_down", f"folder/../{last}"),
        ("double_slash", "folder//part.stl"),
        ("home", f"~/{last}"),
        ("other_case", f"{stem.upper()}.{extension}"),
        ("upper_extension", f"{stem}.{extension.upper()}"),
        ("no_extension", stem),
        ("two_extensions", f"{last}.{extension}"),
        ("dot_at_end", f"{last}."),
        ("percent", f"{stem.replace('a', '%61')}.{extension}"),
        ("percent_space", "with%20space.stl"),
        ("query", f"{last}?x=1"),
        ("fragment", f"{last}#x"),
        ("quotes", f"'{last}'"),
        ("comma", f"{last},{last}"),
        ("long", "x" * 300 + f".{extension}"),
        ("empty_stem", f".{extension}"),
    ):
        yield as_written(label, text)


VERSIONS = (
    "1.0", "1.1", "1.2", "1.3", "2.0", "1", "1.0.0", "01.0", "1.00", "+1.0", "-1.0", "1,0", "1.x", "x", "v1.0", "0.9",
    "1. 0", "1.0a", ".1", "1.", "1..0", "1.4294967296", "1e0", "latest",
)  # fmt: skip


def version(value: str) -> Iterator[Variant]:
    yield from spaced(value)
    for text in VERSIONS:
        if text != value:
            yield f"is_{text}", text, None


def text(value: str) -> Iterator[Variant]:
    yield from spaced(value)
    yield "other", f"{value}_2", None
    yield "upper", value.upper(), None
    yield "unicode", f"{value}ö", None
    yield "long", value + "x" * 300, None
    yield "reference", f"&#{ord(value[0])};{value[1:]}", None


KINDS: dict[str, Callable[[str], Iterator[Variant]]] = {
    "number": number,
    "vector": vector,
    "rgba": rgba,
    "name": name,
    "type": joint_type,
    "filename": filename,
    "version": version,
    "text": text,
}


def kind(element: str, attribute: str) -> str:
    if attribute == "name" or (element, attribute) in {("parent", "link"), ("child", "link"), ("mimic", "joint")}:
        return "name"
    if attribute in {"xyz", "rpy", "size", "scale", "quat_xyzw"}:
        return "vector"
    if (element, attribute) == ("joint", "type"):
        return "type"
    if attribute in {"rgba", "filename", "version"}:
        return attribute
    if element in {"gazebo", "note", "verbose", "property"}:
        return "text"
    return "number" if attribute not in {"reference", "author", "type"} else "text"
