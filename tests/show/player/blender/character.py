"""Builds a rigged character and a small scene in Blender, exports both, and writes where their vertices truly are.

    blender --background --factory-startup --python-exit-code 1 --python character.py -- FOLDER

Writes character.glb, character.fbx (centimetres), character-metres.fbx, character.obj and truth.json. Blender's axes are
those of a show: +Z up, metres. The exporter of glTF needs python3-numpy.
"""
import json
import math
import os
import sys

import bmesh
import bpy
from mathutils import Matrix, Vector

FOLDER = os.path.abspath(sys.argv[sys.argv.index("--") + 1])  # some exporters refuse a relative path
RATE, LAST = 30, 60  # the clips run from frame 0, so from time 0
FRAMES = [0, 7, 15, 22, 30, 45, 60]  # exports hold one key a frame, so they are exact at whole frames only

BONES = [  # name, head, tail, parent
    ("hips", (0, 0, 0.95), (0, 0, 1.15), None),
    ("spine", (0, 0, 1.15), (0, 0, 1.5), "hips"),
    ("head", (0, 0, 1.5), (0, 0, 1.85), "spine"),
    ("upper_arm.L", (0.18, 0, 1.42), (0.48, 0, 1.42), "spine"),
    ("forearm.L", (0.48, 0, 1.42), (0.8, 0, 1.42), "upper_arm.L"),
    ("upper_arm.R", (-0.18, 0, 1.42), (-0.48, 0, 1.42), "spine"),
    ("forearm.R", (-0.48, 0, 1.42), (-0.8, 0, 1.42), "upper_arm.R"),
    ("leg.L", (0.1, 0, 0.95), (0.1, 0.01, 0.04), "hips"),
    ("leg.R", (-0.1, 0, 0.95), (-0.1, 0.01, 0.04), "hips"),
]

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.fps, scene.render.fps_base = RATE, 1.0
scene.frame_start, scene.frame_end = 0, LAST
scene.unit_settings.system, scene.unit_settings.scale_length = "METRIC", 1.0


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    return thing


def checked_picture(size=64):
    picture = bpy.data.images.new("skin_base", size, size, alpha=False)
    pixels = []
    for y in range(size):
        for x in range(size):
            dark = (x // 8 + y // 8) % 2 == 0
            pixels += [0.85, 0.3, 0.2, 1] if dark else [0.2 + 0.5 * x / size, 0.6, 0.3 + 0.5 * y / size, 1]
    picture.pixels[:] = pixels
    picture.filepath_raw, picture.file_format = os.path.join(FOLDER, "skin_base.png"), "PNG"
    picture.save()
    picture.pack()
    return picture


def material(name, colour, picture=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    surface = made.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = colour
    if picture:
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = picture
        made.node_tree.links.new(node.outputs["Color"], surface.inputs["Base Color"])
    return made


def rig():
    armature = add("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    for name, head, tail, parent in BONES:
        bone = armature.data.edit_bones.new(name)
        bone.head, bone.tail = head, tail
        if parent:
            bone.parent = armature.data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    armature.location, armature.rotation_euler = (0.3, -0.2, 0.05), (0, 0, math.radians(25))
    for bone in armature.pose.bones:
        bone.rotation_mode = "QUATERNION"
    return armature


def add_tube(shape, uvs, start, end, first_radius, last_radius, sides, rings):
    start, end = Vector(start), Vector(end)
    along = (end - start).to_track_quat("Z", "Y")
    rows = []
    for j in range(rings):
        f = j / (rings - 1)
        radius = first_radius + (last_radius - first_radius) * f
        turns = [2 * math.pi * k / sides + 0.1 for k in range(sides)]
        rows.append([
            shape.verts.new(start.lerp(end, f) + along @ Vector((radius * math.cos(t), radius * math.sin(t), 0)))
            for t in turns
        ])
    for j in range(rings - 1):
        for k in range(sides):
            after = (k + 1) % sides
            face = shape.faces.new([rows[j][k], rows[j][after], rows[j + 1][after], rows[j + 1][k]])
            face.smooth = True
            corners = [(k, j), (k + 1, j), (k + 1, j + 1), (k, j + 1)]
            for loop, (u, v) in zip(face.loops, corners):
                loop[uvs].uv = (u / sides, v / (rings - 1))


def distance_to(point, start, end):
    start, end = Vector(start), Vector(end)
    along = end - start
    f = max(0, min(1, (point - start).dot(along) / along.length_squared))
    return (point - start.lerp(end, f)).length


def bind(body):
    """At most four bones a vertex, the nearest ones. The exporter of glTF leaves out weights of about 1e-4."""
    groups = {name: body.vertex_groups.new(name=name) for name, *_ in BONES}
    for vertex in body.data.vertices:
        nearness = [(1 / (distance_to(vertex.co, head, tail) + 0.02) ** 4, name) for name, head, tail, _ in BONES]
        whole = sum(weight for weight, _ in nearness)
        strongest = [(w, name) for w, name in sorted(nearness, reverse=True)[:4] if w > 0.01 * whole]
        total = sum(weight for weight, _ in strongest)
        for weight, name in strongest:
            groups[name].add([vertex.index], weight / total, "REPLACE")


def character(skin):
    armature = rig()
    shape = bmesh.new()
    uvs = shape.loops.layers.uv.new("UVMap")
    add_tube(shape, uvs, (0, 0, 0.9), (0, 0, 1.5), 0.15, 0.2, 12, 10)
    add_tube(shape, uvs, (0, -0.01, 1.5), (0, -0.01, 1.84), 0.1, 0.09, 10, 7)
    for side in (1, -1):
        add_tube(shape, uvs, (side * 0.15, 0, 1.42), (side * 0.82, 0, 1.42), 0.07, 0.045, 8, 10)
        add_tube(shape, uvs, (side * 0.1, 0, 0.97), (side * 0.1, 0.01, 0.02), 0.09, 0.06, 8, 10)
    mesh = bpy.data.meshes.new("Body")
    shape.to_mesh(mesh)
    shape.free()
    mesh.materials.append(skin)
    body = add("Body", mesh)
    bind(body)
    body.parent = armature
    body.modifiers.new("Armature", "ARMATURE").object = armature
    return armature, body


def clear_pose(armature):
    for bone in armature.pose.bones:
        bone.matrix_basis = Matrix()


def action(armature, name, keys):
    """keys: (frame, {bone: ((degrees about x, y, z), location)})"""
    made = bpy.data.actions.new(name)
    made.use_fake_user = True
    armature.animation_data.action = made
    clear_pose(armature)
    moved = sorted({bone for _, poses in keys for bone in poses})
    for frame, poses in keys:
        for bone_name in moved:
            bone = armature.pose.bones[bone_name]
            turns, place = poses.get(bone_name, ((0, 0, 0), (0, 0, 0)))
            x, y, z = (Matrix.Rotation(math.radians(t), 4, axis).to_quaternion() for t, axis in zip(turns, "XYZ"))
            bone.rotation_quaternion = z @ y @ x
            bone.location = place
            bone.keyframe_insert("rotation_quaternion", frame=frame, group=bone_name)
            bone.keyframe_insert("location", frame=frame, group=bone_name)
    return made


def clips(armature):
    still = (0, 0, 0)

    def step(side, lift):
        return {
            "leg.L": ((side * 35, 0, 0), still), "leg.R": ((-side * 35, 0, 0), still),
            "upper_arm.L": ((10, -side * 30, 20), still), "upper_arm.R": ((10, -side * 30, -20), still),
            "spine": ((5, side * 10, 0), still), "hips": ((0, -side * 6, 0), (0, lift, 0.02)),
        }

    def wave(bend, turn):
        return {
            "upper_arm.R": ((0, 20, 70), still), "forearm.R": ((bend, 0, 60), still), "head": ((0, turn, 8), still),
        }

    armature.animation_data_create()
    return [
        action(armature, "walk", [(0, step(1, 0)), (15, step(0, 0.05)), (30, step(-1, 0)), (45, step(0, 0.05)),
                                  (60, step(1, 0))]),
        action(armature, "wave", [(0, {}), (10, wave(-30, 5)), (25, wave(35, -5)), (40, wave(-30, 5)), (60, {})]),
    ]


def yard(stone):
    """A chain of blocks with uneven scales, a mirrored one, two instances of a collection, and the ground."""
    root = add("Yard", None)
    root.location, root.rotation_euler = (0, 1.5, 0), (0, 0, math.radians(-15))
    shape = bmesh.new()
    bmesh.ops.create_cube(shape, size=1.0)
    block = bpy.data.meshes.new("Block")
    shape.to_mesh(block)
    shape.free()
    block.materials.append(stone)
    above = root
    for i in range(3):
        one = add("Block%d" % i, block)
        one.parent = above
        one.location = (-1.5, 0, 0) if i == 0 else (0.2, 0.1, 1.0)
        one.rotation_euler = (0, math.radians(6 * i), math.radians(20 * i))
        one.scale = (0.6, 0.6, 0.8) if i == 0 else (0.8, 0.8, 0.7)
        above = one
    mirrored = add("BlockMirrored", block)
    mirrored.parent, mirrored.location, mirrored.scale = root, (1.5, 0, 0), (-0.5, 0.5, 1.2)
    kit = bpy.data.collections.new("Kit")
    part = bpy.data.objects.new("KitPart", block)
    part.location, part.scale = (0, 0, 0.1), (0.3, 0.3, 0.3)
    kit.objects.link(part)
    for i in range(2):
        instance = add("KitInstance%d" % i, None)
        instance.instance_type, instance.instance_collection = "COLLECTION", kit
        instance.parent, instance.location, instance.rotation_euler = root, (i - 0.5, 0.8, 0), (0, 0, 0.5 * i)
    ground = bpy.data.meshes.new("Ground")
    ground.from_pydata([(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)], [], [(0, 1, 2, 3)])
    ground.materials.append(stone)
    add("Ground", ground)


def camera_and_lights():
    camera = add("Camera", bpy.data.cameras.new("Camera"))
    camera.location = (2.2, -4.2, 1.9)
    scene.camera = camera
    for name, kind, energy in (("Sun", "SUN", 3), ("Lamp", "POINT", 60), ("Spot", "SPOT", 150)):
        light = bpy.data.lights.new(name, kind)
        light.energy = energy
        add(name, light).location = (0, 0, 5)


def numbers(points):
    return [c for p in points for c in p]


def posed(body, frame):
    scene.frame_set(frame)
    evaluated = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    places = numbers(evaluated.matrix_world @ v.co for v in mesh.vertices)
    evaluated.to_mesh_clear()
    return places


def truth_of(armature, body, actions):
    truth = {"bones": [[name, parent] for name, _, _, parent in BONES], "clips": {}, "static": {}}
    for one in actions:
        clear_pose(armature)  # an action does not reset what it does not key
        armature.animation_data.action = one
        truth["clips"][one.name] = [{"time": f / RATE, "positions": posed(body, f)} for f in FRAMES]
    # A pose that is left on the rig would be exported into all channels without keys.
    armature.animation_data.action = None
    clear_pose(armature)
    truth["rest"] = posed(body, 0)
    for i, instance in enumerate(bpy.context.evaluated_depsgraph_get().object_instances):
        thing = instance.object
        if thing.type == "MESH" and thing.name != "Body":
            places = numbers(instance.matrix_world @ v.co for v in thing.data.vertices)
            truth["static"]["%s %d" % (thing.name, i)] = places
    return truth


def export(armature, actions):
    for one in actions:  # the exporter of glTF reads actions on tracks, also on muted ones
        track = armature.animation_data.nla_tracks.new()
        track.name, track.mute = one.name, True
        track.strips.new(one.name, 0, one).name = one.name
    at = lambda name: os.path.join(FOLDER, name)
    bpy.ops.export_scene.gltf(
        filepath=at("character.glb"), export_format="GLB", export_cameras=True, export_lights=True,
        export_nla_strips=True, export_force_sampling=True, export_frame_range=False)
    for name, scaling in (("character.fbx", "FBX_SCALE_NONE"), ("character-metres.fbx", "FBX_SCALE_UNITS")):
        bpy.ops.export_scene.fbx(
            filepath=at(name), apply_scale_options=scaling, add_leaf_bones=False, bake_anim_use_nla_strips=False,
            bake_anim_use_all_actions=True, bake_anim_simplify_factor=0.0, path_mode="COPY", embed_textures=True)
    bpy.ops.wm.obj_export(filepath=at("character.obj"), export_animation=False)


skin, stone = material("Skin", (0.8, 0.8, 0.8, 1), checked_picture()), material("Stone", (0.5, 0.5, 0.55, 1))
armature, body = character(skin)
actions = clips(armature)
yard(stone)
camera_and_lights()
truth = truth_of(armature, body, actions)
with open(os.path.join(FOLDER, "truth.json"), "w") as file:
    json.dump(truth, file)
export(armature, actions)
