"""blender -b --factory-startup --python cycles_light.py -- SCENE SPP OUT.exr [MESH.obj]    SCENE: s1 s2 s3 small front
Builds an anchor scene from light_model.py and renders it with Cycles on the CPU (unclamped, no denoiser, no adaptive sampling)."""
import math
import os
import sys
import time

t_start = time.time()
import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True
import light_model as m

args = sys.argv[sys.argv.index('--') + 1:]
scene_name, spp, out = args[0], int(args[1]), args[2]
bpy.ops.wm.read_factory_settings(use_empty=True)
sc = bpy.context.scene
sc.render.engine = 'CYCLES'
cy = sc.cycles
cy.device = 'CPU'
cy.samples = spp
cy.use_adaptive_sampling = False
cy.use_denoising = False
cy.sample_clamp_direct = cy.sample_clamp_indirect = 0
cy.blur_glossy = 0
cy.caustics_reflective = cy.caustics_refractive = True
cy.pixel_filter_type = 'BOX'
cy.seed = int(os.environ.get('CYCLES_SEED', '0'))
sc.render.threads_mode = 'FIXED'
sc.render.threads = int(os.environ.get('CYCLES_THREADS', '2'))
sc.render.image_settings.file_format = 'OPEN_EXR'
sc.render.image_settings.color_depth = '32'
sc.render.image_settings.color_mode = 'RGB'
sc.view_settings.view_transform = 'Raw'
sc.render.filepath = out


def bounces(n, diffuse=None):
    cy.max_bounces = cy.glossy_bounces = cy.transmission_bounces = cy.transparent_max_bounces = n
    cy.diffuse_bounces = n if diffuse is None else diffuse


def camera(cam, w, h):
    sc.render.resolution_x, sc.render.resolution_y, sc.render.resolution_percentage = w, h, 100
    eye, at, fov = Vector(cam[0]), Vector(cam[1]), cam[2]
    f = (at - eye).normalized()
    r = f.cross(Vector((0, 1, 0))).normalized()
    u = r.cross(f)
    data = bpy.data.cameras.new('cam')
    data.sensor_fit, data.angle_y = 'VERTICAL', math.radians(fov)
    data.clip_end = 1e5
    ob = bpy.data.objects.new('cam', data)
    ob.matrix_world = Matrix.Translation(eye) @ Matrix((r, u, -f)).transposed().to_4x4()
    sc.collection.objects.link(ob)
    sc.camera = ob


def material(kind, color=(1, 1, 1), **kw):
    mat = bpy.data.materials.new(kind)
    mat.use_nodes = True
    nt = mat.node_tree
    nt.nodes.clear()
    o = nt.nodes.new('ShaderNodeOutputMaterial')
    b = nt.nodes.new({'diffuse': 'ShaderNodeBsdfDiffuse', 'mirror': 'ShaderNodeBsdfGlossy', 'metal': 'ShaderNodeBsdfGlossy',
                      'glass': 'ShaderNodeBsdfGlass', 'emit': 'ShaderNodeEmission', 'plastic': 'ShaderNodeBsdfPrincipled'}[kind])
    b.inputs[0].default_value = (*color, 1)
    if kind == 'mirror':
        b.distribution, b.inputs['Roughness'].default_value = 'SHARP', 0
    if kind == 'metal':
        b.distribution, b.inputs['Roughness'].default_value = 'GGX', kw['roughness']
    if kind == 'glass':
        b.distribution, b.inputs['Roughness'].default_value, b.inputs['IOR'].default_value = 'SHARP', 0, 1.5
    if kind == 'emit':
        b.inputs['Strength'].default_value = kw['strength']
    if 'checker' in kw:
        t, g = nt.nodes.new('ShaderNodeTexChecker'), nt.nodes.new('ShaderNodeNewGeometry')
        t.inputs['Color1'].default_value, t.inputs['Color2'].default_value = (*kw['checker'][0], 1), (*kw['checker'][1], 1)
        t.inputs['Scale'].default_value = 1
        nt.links.new(g.outputs['Position'], t.inputs['Vector'])
        nt.links.new(t.outputs['Color'], b.inputs[0])
    nt.links.new(b.outputs[0], o.inputs['Surface'])
    return mat


def mesh(verts, faces, mat, smooth=False):
    d = bpy.data.meshes.new('m')
    d.from_pydata(verts, [], faces)
    if smooth:
        d.polygons.foreach_set('use_smooth', [True] * len(d.polygons))
    d.materials.append(mat)
    ob = bpy.data.objects.new('m', d)
    sc.collection.objects.link(ob)
    return ob


def sphere(c, r, mat, sub=6):
    import bmesh
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=sub, radius=r)
    d = bpy.data.meshes.new('s')
    bm.to_mesh(d)
    bm.free()
    d.polygons.foreach_set('use_smooth', [True] * len(d.polygons))
    d.materials.append(mat)
    ob = bpy.data.objects.new('s', d)
    ob.location = c
    sc.collection.objects.link(ob)


def sky(rgb):
    w = bpy.data.worlds.new('w')
    sc.world = w
    w.use_nodes = True
    w.node_tree.nodes['Background'].inputs[0].default_value = (*rgb, 1)


def point(c, power):  # radiant intensity I = power / (4 pi) per channel in Blender units
    l = bpy.data.lights.new('p', 'POINT')
    l.energy, l.shadow_soft_size = power * math.pi, 0
    ob = bpy.data.objects.new('p', l)
    ob.location = c
    sc.collection.objects.link(ob)


def obj_mesh(path, mat):
    bpy.ops.wm.obj_import(filepath=path, forward_axis='NEGATIVE_Z', up_axis='Y')
    ob = bpy.context.selected_objects[0]
    ob.matrix_world = Matrix()
    ob.data.materials.clear()
    ob.data.materials.append(mat)


if scene_name == 's1':
    camera(m.S1_CAM, 512, 512)
    bounces(8)
    for c, a in m.S1_QUADS:
        mesh(c, [(0, 1, 2, 3)], material('diffuse', a))
    c, r, e = m.S1_LIGHT
    n = 96
    disk = [(c[0] + r * math.cos(2 * math.pi * k / n), c[1], c[2] + r * math.sin(2 * math.pi * k / n)) for k in range(n)]
    mesh(disk, [tuple(range(n))], material('emit', strength=e))
    sphere(*m.S1_MIRROR, material('mirror', (.999,) * 3))
    sphere(*m.S1_GLASS, material('glass', (1, 1, 1)))
elif scene_name in ('s2', 'front'):
    camera(m.S2_CAM, *((960, 960) if scene_name == 's2' else (16, 16)))
    bounces(6 if scene_name == 's2' else 1)
    sky((m.S2_SKY,) * 3)
    g, ga = m.S2_GROUND
    mesh([(-g, 0, g), (g, 0, g), (g, 0, -g), (-g, 0, -g)], [(0, 1, 2, 3)], material('diffuse', ga))
    c, h, e = m.S2_LIGHT
    mesh([(c[0] - h, c[1], c[2] - h), (c[0] + h, c[1], c[2] - h), (c[0] + h, c[1], c[2] + h), (c[0] - h, c[1], c[2] + h)],
         [(0, 1, 2, 3)], material('emit', strength=e))
    obj_mesh(args[3], material('metal', m.S2_METAL[0], roughness=m.S2_METAL[1]))
elif scene_name == 's3':
    camera(m.S3_CAM, 1920, 1080)
    bounces(m.S3_DEPTH, 0)
    sky(m.S3_SKY)
    point(*m.S3_LIGHT)
    mesh([(-20, 0, 20), (20, 0, 20), (20, 0, -20), (-20, 0, -20)], [(0, 1, 2, 3)], material('diffuse', checker=m.S3_CHECK))
    for c, r, kind, col in m.S3_SPHERES:
        sphere(c, r, material(kind, {'mirror': (.9,) * 3, 'glass': (1, 1, 1), 'plastic': col}[kind]), 5)
else:
    camera(m.SMALL_CAM, 200, 200)
    bounces(1, 0)
    point(*m.SMALL_LIGHT)
    mesh([(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)], [(0, 1, 2, 3)], material('diffuse', (.6, .6, .6)))
    for c, r, col in m.SMALL_SPHERES:
        sphere(c, r, material('plastic', col), 5)

t_scene = time.time()
bpy.ops.render.render(write_still=True)
print('CYCLES_TIMES scene %.3f s render+write %.3f s' % (t_scene - t_start, time.time() - t_scene))
