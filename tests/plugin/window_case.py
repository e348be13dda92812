# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests in a window share: a script that gives Blender time between its steps, and an exit code for it, which Blender has
for none that fails beside a window."""

import os
import sys
import time
import traceback

import bpy

bpy.context.preferences.view.show_splash = False  # before there is a window

GIVE_UP_S = 150.0


def window():
    return bpy.context.window_manager.windows[0]


def area(kind):
    return next(each for each in window().screen.areas if each.type == kind)


def override(of):
    region = next(r for r in of.regions if r.type == "WINDOW")
    return {"window": window(), "screen": window().screen, "area": of, "region": region}


def shoot(path, of):
    """A picture of the window with this area in it, as soon as no engine renders: meanwhile Blender lets no operator run."""
    end = time.monotonic() + GIVE_UP_S
    while True:
        try:
            with bpy.context.temp_override(window=window(), area=of):
                bpy.ops.screen.screenshot(filepath=path)
            break
        except RuntimeError as refusal:
            if "drawing/rendering" not in str(refusal) or time.monotonic() > end:
                raise
        yield 0.1
    assert os.path.getsize(path) > 2000, path


def press(key):
    """A key goes down and up, in the middle of the window. Takes --enable-event-simulate."""
    x, y = window().width // 2, window().height // 2
    for value in ("PRESS", "RELEASE"):
        window().event_simulate(type=key, value=value, x=x, y=y)


def wait_for(what, condition):
    """Gives Blender time until the condition holds."""
    end = time.monotonic() + GIVE_UP_S
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"waited in vain for {what}")
        yield 0.1


def run(name, script):
    """Runs a generator that yields seconds to wait."""
    steps = script()

    def step():
        try:
            return next(steps)
        except StopIteration:
            print(f"{name}: ok", flush=True)
            os._exit(0)
        except BaseException:
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(3)

    bpy.app.timers.register(step, first_interval=1.0)
