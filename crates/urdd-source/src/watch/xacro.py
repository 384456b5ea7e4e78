"""Stands before the package `xacro`: loads that one, and watches it."""

import atexit
import importlib
import os
import sys

here = os.path.realpath(os.path.join(os.path.dirname(__file__), ".."))
try:
    from urdd_xacro import documents, macros
except Exception:
    documents = None
sys.path[:] = [path for path in sys.path if os.path.realpath(path) != here]
del sys.modules["xacro"]
importlib.import_module("xacro")
try:
    watched = documents.Watch()
    documents.watch(watched)
    atexit.register(watched.end, os.environ["URDD_XACRO_PLACES"])
    macros.watch(watched, sys.modules["xacro"])
except Exception:
    pass
