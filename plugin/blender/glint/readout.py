# SPDX-License-Identifier: GPL-3.0-or-later
"""How many flakes a pixel of the active camera sees, and how many of them shine: what density means in the picture."""

import math

# The sun's solid angle, sr: what a lit flake must reflect.
SUN_SR = 6.8e-5


def pixel_side_m(scene, target):
    """Side of a square that a pixel of the scene's camera covers at the object, facing the camera; None without one."""
    camera = scene.camera
    if camera is None or target is None:
        return None
    data, render = camera.data, scene.render
    scale = render.resolution_percentage / 100.0
    width, height = render.resolution_x * scale, render.resolution_y * scale
    if data.type == "ORTHO":
        return data.ortho_scale / max(width, height)
    distance = (camera.matrix_world.translation - target.matrix_world.translation).length
    side = {"HORIZONTAL": width, "VERTICAL": height}.get(data.sensor_fit, max(width, height))
    sensor = data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width
    return distance * sensor / (data.lens * side)


def lit_share(alpha):
    """Probability that a flake in the middle of the highlight mirrors the sun to the camera, GGX, head-on: D(n) Omega / (4
    D_H), D(n) = 1 / (pi alpha^2), D_H about 1."""
    return min(1.0, SUN_SR / (4.0 * math.pi * alpha * alpha))


def flakes_per_pixel(scene, object_, values, stretch=None):
    """None where there is no camera. stretch  of the UV map that the flakes lie in: what a unit of it really measures."""
    side = pixel_side_m(scene, object_)
    if side is None:
        return None
    count = values.density_per_cm2 * 1e4 * side**2
    if values.space == "UV" and stretch is not None:
        count *= (values.uv_scale / stretch.middle) ** 2
    return count


def lines(scene, object_, values, alpha, stretch=None):
    """What the panel says below the density."""
    count = flakes_per_pixel(scene, object_, values, stretch)
    if count is None:
        return ["No camera: flakes per pixel unknown"]
    return [f"{count:.3g} flakes per pixel", f"{count * lit_share(alpha):.3g} glints per pixel under the sun"]
