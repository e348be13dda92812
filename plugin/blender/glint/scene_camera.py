# SPDX-License-Identifier: GPL-3.0-or-later
"""Cameras and views for libglint_preview, from Blender's own projection matrices: sensor fit, lens shift, orthographic
scale and pixel aspect are in them already."""

import numpy

from . import abi
from .scene_data import to_world


def _perspective(p, scale):
    # P maps the plane at distance 1 to [-1, 1]: x' = P00 x - P02.
    return abi.Camera(
        projection=abi.PERSPECTIVE, left=(p[0][2] - 1.0) / p[0][0], right=(p[0][2] + 1.0) / p[0][0],
        bottom=(p[1][2] - 1.0) / p[1][1], top=(p[1][2] + 1.0) / p[1][1],
        near_m=p[2][3] / (p[2][2] - 1.0) * scale, far_m=p[2][3] / (p[2][2] + 1.0) * scale,
    )


def _orthographic(p, scale):
    # x' = P00 x + P03; z' = P22 z + P23 is -1 at the near plane, and z points backwards.
    near, far = (p[2][3] + 1.0) / p[2][2], (p[2][3] - 1.0) / p[2][2]
    camera = abi.Camera(
        projection=abi.ORTHOGRAPHIC, left=(-1.0 - p[0][3]) / p[0][0] * scale, right=(1.0 - p[0][3]) / p[0][0] * scale,
        bottom=(-1.0 - p[1][3]) / p[1][1] * scale, top=(1.0 - p[1][3]) / p[1][1] * scale,
    )
    # A viewport also shows what lies behind its eye: the camera steps back.
    behind = max(-near, 0.0)
    camera.near_m, camera.far_m = (near + behind) * scale, (far + behind) * scale
    return camera, behind * scale


def camera_of(projection, matrix, scale):
    """From a 4 x 4 projection matrix of OpenGL's and the camera's matrix in the world."""
    p = numpy.array(projection, numpy.float64)
    to_camera = to_world(matrix, scale, turn_object=False)
    if p[3][3] == 0.0:
        camera = _perspective(p, scale)
    else:
        camera, behind = _orthographic(p, scale)
        backward = to_camera[8:11] / numpy.linalg.norm(to_camera[8:11])
        to_camera[12:15] += (behind * backward).astype(numpy.float32)
    camera.to_world = tuple(to_camera)
    return camera


def of_render(depsgraph, warn):
    """The camera of a final render; None without one."""
    scene = depsgraph.scene
    if scene.camera is None:
        return None
    source = scene.camera.evaluated_get(depsgraph)
    render, scale = scene.render, scene.unit_settings.scale_length
    width, height = resolution(scene)
    if source.data.type == "PANO":
        warn(f"{source.name}: panoramic cameras are not rendered; a perspective one stands in")
    if source.data.dof.use_dof:
        warn(f"{source.name}: depth of field is not rendered")
    projection = source.calc_matrix_camera(depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x,
                                           scale_y=render.pixel_aspect_y)
    return camera_of(projection, source.matrix_world, scale)


def of_view(region_data, scene):
    """What a viewport looks through."""
    return camera_of(region_data.window_matrix, region_data.view_matrix.inverted(), scene.unit_settings.scale_length)


def resolution(scene):
    """Width and height of the whole picture."""
    render = scene.render
    percent = render.resolution_percentage
    return max(render.resolution_x * percent // 100, 1), max(render.resolution_y * percent // 100, 1)


def border(scene):
    """The part of the picture to render: left, bottom, width and height, pixels from the lower left corner. As Blender
    rounds it."""
    width, height = resolution(scene)
    render = scene.render
    if not render.use_border:
        return 0, 0, width, height
    left, right = int(render.border_min_x * width), int(render.border_max_x * width)
    bottom, top = int(render.border_min_y * height), int(render.border_max_y * height)
    return left, bottom, max(right - left, 1), max(top - bottom, 1)
