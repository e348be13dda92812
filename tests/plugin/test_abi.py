# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's ctypes are those of the header, and a library that speaks another language is refused.

    /usr/bin/python3 test_abi.py LIBRARY
"""

import ctypes
import os
import sys
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "plugin", "blender"))
sys.path.insert(0, os.path.join(HERE, "..", "..", "plugin", "blender", "glint"))

import abi  # noqa: E402
import make_abi  # noqa: E402

LIBRARY = sys.argv.pop()


class Abi(unittest.TestCase):
    def test_it_is_what_the_header_says(self):
        with open(make_abi.HEADER, encoding="utf-8") as header, open(make_abi.OUTPUT, encoding="utf-8") as made:
            self.assertEqual(made.read(), make_abi.make(header.read()), "run plugin/blender/make_abi.py")

    def test_a_library_of_this_header_loads(self):
        self.assertEqual(abi.load(LIBRARY).glint_preview_abi(), abi.ABI)

    def test_defaults_are_those_of_the_macros(self):
        camera = abi.Camera()
        self.assertEqual((camera.size, camera.left, camera.right), (ctypes.sizeof(abi.Camera), -0.5, 0.5))
        self.assertEqual(abi.SceneOptions().world.size, ctypes.sizeof(abi.World))
        self.assertEqual(abi.SceneOptions().model, -1)
        self.assertEqual(tuple(abi.World().map_rotation), (0.0, 0.0, 0.0, 1.0))

    def test_another_abi_or_another_size_is_refused(self):
        abi.ABI += 1
        try:
            with self.assertRaisesRegex(OSError, "found ABI 1, expected 2"):
                abi.load(LIBRARY)
        finally:
            abi.ABI -= 1
        longer = type("Longer", (ctypes.Structure,), {"NAME": "glint_preview_mesh", "_fields_": [("x", ctypes.c_char * 7)]})
        structs, abi.STRUCTS = abi.STRUCTS, (longer,)
        try:
            with self.assertRaisesRegex(OSError, "bytes in glint_preview_mesh, expected 7"):
                abi.load(LIBRARY)
        finally:
            abi.STRUCTS = structs

    def test_what_is_no_such_library_is_refused(self):
        for path in ("/no/such/library.so", os.path.realpath(__file__)):
            with self.assertRaises(OSError):
                abi.load(path)


unittest.main(verbosity=2)
