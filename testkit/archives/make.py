"""Makes the archives of this folder: a package with a robot of two meshes, packed as people's programs pack it.

    python3 testkit/archives/make.py     needs zip, git, 7z (p7zip-full) and bsdtar (libarchive-tools)

macOS and Windows are written by what their archives are known to hold: no program of theirs runs here. They are committed,
so that no test needs these programs.
"""

import pathlib
import struct
import subprocess
import tempfile
import zlib

HERE = pathlib.Path(__file__).parent
TOP = "arm_description"
STL = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
URDF = """<robot name="arm">
  <link name="base"><visual><geometry><mesh filename="package://arm_description/meshes/base.stl"/></geometry></visual></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/></joint>
  <link name="tip"><visual><geometry><mesh filename="package://arm_description/meshes/äußen.stl"/></geometry></visual></link>
</robot>
"""
FILES = {
    f"{TOP}/package.xml": "<package><name>arm_description</name></package>\n",
    f"{TOP}/urdf/arm.urdf": URDF,
    f"{TOP}/meshes/base.stl": STL,
    f"{TOP}/meshes/äußen.stl": STL,
}
DEFLATED, UTF8, DESCRIBED = 8, 1 << 11, 1 << 3


def run(*words, cwd, out=None):
    subprocess.run(words, cwd=cwd, check=True, stdout=out or subprocess.DEVNULL)


def write(name, entries):
    """An archive of (raw name, content, host system, flags, Unix mode), by PKWARE's APPNOTE."""
    body, listed = b"", b""
    for raw, content, host, flags, mode in entries:
        data = content.encode()
        packed = zlib.compressobj(9, zlib.DEFLATED, -15)
        packed = packed.compress(data) + packed.flush()
        method = DEFLATED if data else 0
        packed = packed if data else b""
        fields = (zlib.crc32(data), len(packed), len(data))
        own = (0, 0, 0) if flags & DESCRIBED else fields
        start = len(body)
        body += struct.pack("<4s5H3L2H", b"PK\x03\x04", 20, flags, method, 0, 0x21, *own, len(raw), 0) + raw + packed
        if flags & DESCRIBED:
            body += struct.pack("<4s3L", b"PK\x07\x08", *fields)
        made_by = host << 8 | 20
        listed += struct.pack("<4s6H3L5H2L", b"PK\x01\x02", made_by, 20, flags, method, 0, 0x21, *fields,
                              len(raw), 0, 0, 0, 0, mode << 16, start) + raw
    end = struct.pack("<4s4H2LH", b"PK\x05\x06", 0, 0, len(entries), len(entries), len(listed), len(body), 0)
    (HERE / name).write_bytes(body + listed + end)


def main():
    for old in HERE.glob("*.zip"):
        old.unlink()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for path, text in FILES.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
        run("zip", "-qr", HERE / "info_zip.zip", TOP, cwd=folder)
        with open(HERE / "info_zip_streamed.zip", "wb") as out:
            streamed = subprocess.run(["zip", "-qr", "-", TOP], cwd=folder, check=True, stdout=subprocess.PIPE)
            out.write(streamed.stdout)
        run("7z", "a", HERE / "seven_zip.zip", TOP, cwd=folder)
        # As Windows 11 packs, which uses libarchive.
        run("bsdtar", "-a", "-cf", HERE / "libarchive.zip", f"./{TOP}", cwd=folder)
        run("git", "init", "-q", cwd=folder)
        run("git", "add", ".", cwd=folder)
        run("git", "-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "a", cwd=folder)
        run("git", "archive", "--prefix=arm-main/", "-o", HERE / "git_archive.zip", "HEAD", cwd=folder)
        run("git", "-c", "core.bigFileThreshold=1", "archive", "-o", HERE / "git_archive_streamed.zip", "HEAD", cwd=folder)
    # Finder: names in UTF-8 without the flag for it, sizes after the content, a twin of each file in __MACOSX.
    unix, file, of_folder = 3, 0o100644, 0o040755
    mac = [(f"{TOP}/".encode(), "", unix, 0, of_folder)]
    for path, text in {**FILES, f"{TOP}/.DS_Store": "\x00\x00\x00\x01Bud1"}.items():
        twin = "__MACOSX/" + path.rpartition("/")[0] + "/._" + path.rpartition("/")[2]
        mac += [(path.encode(), text, unix, DESCRIBED, file), (twin.encode(), "\x00\x05\x16\x07", unix, DESCRIBED, file)]
    write("macos.zip", mac)
    # Explorer of Windows 7 to 10: names in the code page of MS-DOS; of other languages, in UTF-8 with the flag.
    write("explorer.zip", [(path.encode("cp437"), text, 0, 0, 0) for path, text in FILES.items()])
    write("explorer_utf8.zip", [(path.encode(), text, 0, UTF8, 0) for path, text in FILES.items()])
    # .NET before 4.6.1, and PowerShell on it.
    back = {path.replace("/", "\\"): text for path, text in FILES.items()}
    write("dotnet.zip", [(f"{TOP}\\".encode(), "", 0, 0, 0)] + [(path.encode(), text, 0, UTF8, 0) for path, text in back.items()])


if __name__ == "__main__":
    main()
