# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests inside Blender share: the add-on from this checkout, and a runner whose exit code is the truth.

    blender -b --factory-startup --python-exit-code 3 -P test_x.py -- FOLDER
"""

import os
import sys
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "plugin", "blender"))
sys.path.insert(0, HERE)

import bpy  # noqa: E402


def fresh():
    """An empty file with the add-on on."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    import addon_utils

    if addon_utils.enable("glint", default_set=True) is None:
        raise RuntimeError("the add-on does not register")


def folder():
    """A folder for files, from the command line."""
    path = sys.argv[sys.argv.index("--") + 1]
    os.makedirs(path, exist_ok=True)
    return path


def run(*cases):
    """Runs test cases; Blender's exit code is 3 when one fails."""
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in cases)
    result = unittest.TextTestRunner(verbosity=2, stream=sys.stdout).run(suite)
    if not result.wasSuccessful() or result.testsRun == 0:
        sys.stdout.flush()
        raise RuntimeError("tests failed")
