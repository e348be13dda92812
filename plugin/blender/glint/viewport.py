# SPDX-License-Identifier: GPL-3.0-or-later
"""A view that fills in sample by sample: one thread owns the library's scene and picture, the main one only asks and looks.

The main thread puts down what it wants, a scene or a view, and wakes the thread, which drops what it is doing.
"""

import dataclasses
import threading
import weakref

import numpy

from . import abi
from .library import GlintError, Picture, Scene
from .scene_change import NOTHING, changed_parts

# While somebody turns the view a first picture of a sixteenth of the pixels is there at once.
DRAFT = 4


@dataclasses.dataclass
class View:
    """What a picture depends on besides the scene."""

    camera: abi.Camera
    width: int
    height: int
    samples: int
    bounces: int
    seed: int
    transparent: bool
    accuracy: float = 0.0
    threads: int = 0

    def same_as(self, other):
        return other is not None and bytes(self.camera) == bytes(other.camera) and all(
            getattr(self, field.name) == getattr(other, field.name)
            for field in dataclasses.fields(self) if field.name != "camera"
        )


@dataclasses.dataclass
class Frame:
    """Pixels to show."""

    pixels: numpy.ndarray
    width: int
    height: int
    view: View
    description: object  # of the scene that they show
    samples: int


class Session:
    """The thread and what it shares. redraw, a method, is called by it whenever there is something new to see; whose method it is
    may go before the thread does."""

    def __init__(self, redraw):
        self._redraw_method = weakref.WeakMethod(redraw)
        self._wake = threading.Condition()
        self._description = self._view = None
        self._last = None  # description that was asked for
        self._scene = self._held = None  # the thread's own: the library's scene, and its description
        self._changed = self._ending = False
        self._picture = None
        self.frame, self.problem, self.warnings = None, "", []
        self._thread = threading.Thread(target=self._work, name="glint viewport", daemon=True)
        self._thread.start()

    # ---- called by the main thread ----

    def show_scene(self, description):
        """Begins anew unless it is the same scene, as after a click that selects something."""
        with self._wake:
            if self._last is not None and not self.problem and changed_parts(self._last, description) == NOTHING:
                return
            self._description = self._last = description
            self._interrupt()

    def show_view(self, view):
        """Begins anew where the view is another one."""
        with self._wake:
            if not view.same_as(self._view):
                self._view = view
                self._interrupt()

    def close(self):
        """Ends the thread; returns when it is gone, unless it is the one that asks: it may hold the engine last."""
        with self._wake:
            self._ending = True
            self._interrupt()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def is_done(self):
        frame = self.frame
        return bool(self.problem) or (frame is not None and frame.view is self._view and frame.description is self._last
                                      and frame.samples == frame.view.samples)

    def _interrupt(self):
        self._changed = True
        if self._picture is not None:
            self._picture.cancel()
        self._wake.notify()

    # ---- the thread ----

    def _redraw(self):
        redraw = self._redraw_method()
        if redraw is not None:
            redraw()

    def _work(self):
        while True:
            with self._wake:
                while not self._changed:
                    self._wake.wait()
                self._changed = False
                if self._ending:
                    break
                description, self._description = self._description, None
                view = self._view
            try:
                if description is not None:
                    self._adopt(description)
                if self._scene is not None and view is not None:
                    self._render(self._scene, view)
            except GlintError as problem:
                self.problem = str(problem)
                self._redraw()
        self._drop()

    def _adopt(self, description):
        """Changes the scene at hand where its meshes can stay: a tree of a million triangles takes a second."""
        parts = changed_parts(self._held, description) if self._scene is not None else None
        if parts is None or not self._scene.change(description, parts):
            self._drop()
            self._scene = Scene(description)
        self._held = description
        self.problem, self.warnings = "", description.warnings + self._scene.warnings

    def _drop(self):
        if self._scene is not None:
            self._scene.close()
        self._scene = self._held = None

    def _render(self, scene, view):
        # A draft looks at no plan: that takes longer than it does.
        draft = dataclasses.replace(view, width=max(view.width // DRAFT, 1), height=max(view.height // DRAFT, 1), samples=1,
                                    accuracy=0.0)
        if self._grow(scene, draft, view, (1,)):
            steps = [2**k for k in range(view.samples.bit_length()) if 2**k < view.samples]
            # In the end every pass takes as long as it takes to see a difference: an eighth of what there is.
            fine = [min(n, view.samples) for n in _steps_after(steps, view.samples)]
            self._grow(scene, view, view, fine)

    def _grow(self, scene, settings, view, steps):
        """False: interrupted."""
        picture = Picture(scene, settings.camera, settings.width, settings.height, samples=settings.samples,
                          bounces=settings.bounces, seed=settings.seed, transparent=int(settings.transparent), accuracy=settings.accuracy,
                          threads=settings.threads, passes=0)
        try:
            with self._wake:
                if self._changed:
                    return False
                self._picture = picture
            for samples in steps:
                if not picture.refine(samples):
                    return False
                done = samples if settings is view else 0
                self.frame = Frame(picture.read(abi.COMBINED), settings.width, settings.height, view, self._held, done)
                self._redraw()
            return True
        finally:
            with self._wake:
                self._picture = None
            picture.close()


def _steps_after(doubling, last):
    """1, 2, 4 and 8 samples, then an eighth more each time, and the last."""
    steps = [n for n in doubling if n <= 8]
    n = steps[-1] if steps else 1
    while n < last:
        n = max(n + n // 8, n + 1)
        steps.append(min(n, last))
    return steps or [last]
