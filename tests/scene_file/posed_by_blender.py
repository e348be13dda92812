"""Blender animates a scene, exports it, and says where everything is in each frame; so does our reader of the export.

blender -b --factory-startup --python-exit-code 3 -P posed_by_blender.py -- POSED FOLDER

Curves are exported as they are, with a key every ten frames: what lies between is interpolated here and there. The handles of a key are a
third of the way to the next, where a Bezier curve is glTF's cubic spline.
"""

import os
import subprocess
import sys

import bpy
from mathutils import Matrix

FPS = 24
FRAMES = range(1, 42)
KEYS = (1, 11, 21, 41)
# Single precision in the file and in Blender: some forty roundings of numbers up to 8.
NEAR = 2e-5

posed, folder = sys.argv[sys.argv.index("--") + 1:]
os.makedirs(folder, exist_ok=True)


def animate(thing, path, values):
    for frame, value in zip(KEYS, values):
        setattr(thing, path, value)
        thing.keyframe_insert(path, frame=frame)


def third_of_the_way(curve, slope):
    """Handles at thirds; a slope of None leaves straight lines."""
    points = curve.keyframe_points
    for i, point in enumerate(points):
        if slope is None:
            point.interpolation = "LINEAR"
            continue
        point.interpolation = "BEZIER"
        point.handle_left_type = point.handle_right_type = "FREE"
        x, y = point.co
        before = x - points[i - 1].co[0] if i > 0 else 10.0
        behind = points[i + 1].co[0] - x if i + 1 < len(points) else 10.0
        point.handle_left = (x - before / 3.0, y - slope * before / 3.0)
        point.handle_right = (x + behind / 3.0, y + slope * behind / 3.0)


def make_scene():
    scene = bpy.context.scene
    scene.render.fps = FPS
    scene.frame_start, scene.frame_end = FRAMES[0], FRAMES[-1]
    cube, camera, light = (bpy.data.objects[name] for name in ("Cube", "Camera", "Light"))
    parent = bpy.data.objects.new("Parent", None)
    scene.collection.objects.link(parent)
    cube.parent = camera.parent = parent
    cube.rotation_mode = "QUATERNION"
    animate(parent, "location", ((0, 0, 0), (1, -2, 3), (2, 0, 1), (-3, 4, 0)))
    animate(cube, "rotation_quaternion", ((1, 0, 0, 0), (.8, .6, 0, 0), (.6, 0, .8, 0), (0, .6, 0, .8)))
    animate(cube, "scale", ((1, 1, 1), (2, .5, 1), (1, 3, .25), (.5, .5, .5)))
    animate(camera, "location", ((7, -7, 5), (5, -8, 4), (6, -7, 3), (7, -6, 5)))
    animate(light, "location", ((0, 0, 4), (2, 0, 4), (2, 2, 4), (0, 2, 6)))
    for thing, slope in ((parent, None), (cube, .05), (camera, -.1), (light, 0.0)):
        for curve in thing.animation_data.action.fcurves:
            # The exporter of 3.4 normalises the tangents of quaternions; what is zero it leaves.
            third_of_the_way(curve, 0.0 if curve.data_path == "rotation_quaternion" else slope)
    return scene, {"Cube": cube, "Camera": camera, "Light": light}


def in_gltf(matrix, is_mesh):
    """z is up in Blender, y in glTF; meshes are turned with their vertices, views and lights are not."""
    turn = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))
    return turn @ matrix @ turn.inverted() if is_mesh else turn @ matrix


def poses_of_reader(path):
    """(frame, name): the matrix, for every frame."""
    times = [f"{frame / FPS:.9g}" for frame in FRAMES]
    said = subprocess.run([posed, path, *times], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in said.splitlines():
        words = line.split()
        numbers = [float(word) for word in words[-16:]]
        columns = Matrix([numbers[i:i + 4] for i in range(0, 16, 4)])
        found[round(float(words[0]) * FPS), words[2].split("_")[0]] = columns.transposed()
    return found


def main():
    scene, things = make_scene()
    path = os.path.join(folder, "moving.glb")
    bpy.ops.export_scene.gltf(filepath=path, export_force_sampling=False, export_cameras=True, export_lights=True)
    found = poses_of_reader(path)
    worst = moved = 0.0
    rest = {}
    for frame in FRAMES:
        scene.frame_set(frame)
        for name, thing in things.items():
            expected = in_gltf(thing.matrix_world, name == "Cube")
            difference = max(abs(a - b) for row, other in zip(found[frame, name], expected) for a, b in zip(row, other))
            if not difference < NEAR:
                sys.exit(f"frame {frame}, {name}: off by {difference}: found\n{found[frame, name]}\nexpected\n{expected}")
            worst = max(worst, difference)
            moved = max(moved, (expected.to_translation() - rest.setdefault(name, expected).to_translation()).length)
    print(f"{len(found)} poses, the worst off by {worst:.2g}, the farthest way {moved:.3g}")
    if len(found) != len(FRAMES) * len(things) or moved < 1.0:
        sys.exit("too few poses, or nothing moved")


main()
