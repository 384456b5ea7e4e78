"""Finds packages as ament does, by AMENT_PREFIX_PATH. What urdd gives to xacro where ROS is not installed."""

import os


class PackageNotFoundError(KeyError):
    def __str__(self):
        return f"package '{self.args[0]}' not found"


def get_package_prefix(package_name):
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        packages = os.path.join(prefix, "share", "ament_index", "resource_index", "packages")
        if prefix and os.path.isfile(os.path.join(packages, package_name)):
            return prefix
    raise PackageNotFoundError(package_name)


def get_package_share_directory(package_name):
    return os.path.join(get_package_prefix(package_name), "share", package_name)
