#!/usr/bin/env python3
"""Asks the parsers of ros2_control about the cases, and writes what they do into cases.txt.

    ask.py FOLDER PREFIX_HUMBLE PREFIX_JAZZY

FOLDER has `humble` and `jazzy`, checkouts of these branches of ros-controls/ros2_control. A PREFIX is the folder
`cmeel.prefix` of a Python environment with cmeel-urdfdom, cmeel-urdfdom-headers and cmeel-tinyxml2 (`install` beside this
folder makes `venv_urdfdom4`); needs g++. fmt, rclcpp and urdf are stubs: the parsers take their versions and formats of
messages from the first two, and of the last the model that urdfdom has.
"""

import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
STUBS = {
    "fmt/compile.h": """#pragma once
#include <string>
#define FMT_COMPILE(text) text
namespace fmt { template <class... A> std::string format(const char *text, A &&...) { return text; } }
""",
    "rclcpp/version.h": "#define RCLCPP_VERSION_GTE(a, b, c) 0\n",
    "urdf/model.h": """#pragma once
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
namespace urdf {
struct Model : ModelInterface {
  bool initString(const std::string &text) {
    auto model = parseURDF(text);
    if (model) joints_ = model->joints_;
    return bool(model);
  }
};
}
""",
}
DRIVER = """
#include <fstream>
#include <iostream>
#include <sstream>
#include "hardware_interface/component_parser.hpp"
int main(int, char **arguments) {
  while (*++arguments) {
    std::stringstream text;
    text << std::ifstream(*arguments).rdbuf();
    try {
      hardware_interface::parse_control_resources_from_urdf(text.str());
      std::cout << '+' << std::endl;
    } catch (const std::exception &) {
      std::cout << '-' << std::endl;
    }
  }
}
"""


def build(source, prefix, folder):
    for name, text in {**STUBS, "driver.cpp": DRIVER}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    includes = [folder, source / "hardware_interface/include", source / "joint_limits/include"]
    includes += [prefix / "include" / name for name in ("", "urdfdom", "urdfdom_headers")]
    files = [source / "hardware_interface/src" / name for name in ("component_parser.cpp", "lexical_casts.cpp")]
    libraries = [f"-L{prefix}/lib", f"-Wl,-rpath,{prefix}/lib", "-lurdfdom_model", "-lconsole_bridge", "-ltinyxml2"]
    program = folder / f"parse_{source.name}"
    subprocess.run(
        ["g++", "-std=c++17", *[f"-I{path}" for path in includes], folder / "driver.cpp", *files, *libraries, "-o", program],
        check=True,
    )
    return program


def main():
    sources, *prefixes = map(pathlib.Path, sys.argv[1:])
    base = (HERE / "base.urdf").read_text()
    lines = (HERE / "cases.txt").read_text().split("\n")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        files = []
        for number, line in enumerate(lines):
            if "\t" in line and not line.startswith("#"):
                _, old, new = line.split("\t")
                assert old in base, old
                files.append((number, folder / f"{number}.urdf"))
                files[-1][1].write_text(base.replace(old, new))
        answers = []
        for name, prefix in zip(("humble", "jazzy"), prefixes):
            program = build(sources / name, prefix, folder)
            told = subprocess.run([program, *[file for _, file in files]], stdout=subprocess.PIPE, text=True, check=True)
            answers.append(told.stdout.split())
        for (number, _), *verdicts in zip(files, *answers):
            _, change = lines[number].split("\t", 1)
            lines[number] = "".join(verdicts) + "\t" + change
    (HERE / "cases.txt").write_text("\n".join(lines))


main()
