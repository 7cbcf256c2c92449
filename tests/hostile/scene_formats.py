"""FBX and COLLADA, each wrong in one way or odd and right."""
import struct
import zlib

from corpus import *


def collada(points=P4, faces=F4, up="Y_UP", node="", scene='<instance_geometry url="#g"/>', prim=None, nodes=""):
    numbers = " ".join("%s %s %s" % p for p in points)
    corners = " ".join(str(v) for f in faces for v in f)
    prim = prim or ('<triangles count="%d"><input semantic="VERTEX" source="#v" offset="0"/><p>%s</p></triangles>' %
                    (len(faces), corners))
    return ('<?xml version="1.0"?>\n<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">\n'
            '<asset><up_axis>%s</up_axis></asset>\n'
            '<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="%d">%s</float_array>\n'
            '<technique_common><accessor source="#a" count="%d" stride="3"><param name="X" type="float"/>'
            '<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>\n'
            '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>%s</mesh></geometry></library_geometries>\n'
            '%s<library_visual_scenes><visual_scene id="s"><node id="n">%s%s</node></visual_scene></library_visual_scenes>\n'
            '<scene><instance_visual_scene url="#s"/></scene></COLLADA>\n' %
            (up, 3 * len(points), numbers, len(points), prim, nodes, node, scene))


def fbx(points=P4, faces=F4, version=7400, geometry="", count=None, up=1, connections=""):
    numbers = ",".join(str(c) for p in points for c in p)
    corners = ",".join(str(v if i < len(f) - 1 else -1 - v) for f in faces for i, v in enumerate(f))
    size = 3 * len(points) if count is None else count
    return ("; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: %d\n}\n"
            'GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t\tP: "UpAxis", "int", "Integer", "",%s\n'
            '\t\tP: "UpAxisSign", "int", "Integer", "",1\n\t}\n}\n'
            'Objects:  {\n\tGeometry: 1001, "Geometry::a", "Mesh" {\n\t\tVertices: *%d {\n\t\t\ta: %s\n\t\t}\n'
            "\t\tPolygonVertexIndex: *%d {\n\t\t\ta: %s\n\t\t}\n%s\t}\n"
            '\tModel: 1002, "Model::a", "Mesh" {\n\t\tVersion: 232\n\t}\n}\n'
            'Connections:  {\n\tC: "OO",1002,0\n\tC: "OO",1001,1002\n%s}\n' %
            (version, up, size, numbers, sum(len(f) for f in faces), corners, geometry, connections))


# --- binary FBX: records with the offset of their end, a list of properties, children -----------

def record(name, properties=b"", count=0, children=(), at=0):
    """The bytes of a record that begins at an offset of the file."""
    head = 13 + len(name)
    body = b""
    for child in children:
        body += child(at + head + len(properties) + len(body))
    if children:
        body += bytes(13)
    end = at + head + len(properties) + len(body)
    return struct.pack("<IIIB", end, count, len(properties), len(name)) + name.encode() + properties + body


def node(name, properties=b"", count=0, *children):
    return lambda at: record(name, properties, count, children, at)


def text(value):
    return b"S" + struct.pack("<I", len(value)) + value.encode("latin-1")


def long(value):
    return b"L" + struct.pack("<q", value)


def number(value):
    return b"I" + struct.pack("<i", value)


def array(kind, values, packed=False, length=None, size=None):
    data = struct.pack("<%d%s" % (len(values), kind), *values)
    if packed:
        data = zlib.compress(data)
    return kind.encode() + struct.pack("<III", len(values) if length is None else length, int(packed),
                                       len(data) if size is None else size) + data


def binary_fbx(points=P4, faces=F4, version=7400, vertices=None, indices=None, link=1002):
    values = [float(c) for p in points for c in p]
    corners = [v if i < len(f) - 1 else -1 - v for f in faces for i, v in enumerate(f)]
    top = [node("FBXHeaderExtension", b"", 0, node("FBXVersion", number(version), 1)),
           node("GlobalSettings", b"", 0, node("Version", number(1000), 1)),
           node("Objects", b"", 0,
                node("Geometry", long(1001) + text("a\0\1Geometry") + text("Mesh"), 3,
                     node("Vertices", vertices or array("d", values), 1),
                     node("PolygonVertexIndex", indices or array("i", corners), 1)),
                node("Model", long(1002) + text("a\0\1Model") + text("Mesh"), 3, node("Version", number(232), 1))),
           node("Connections", b"", 0, node("C", text("OO") + long(1002) + long(0), 3),
                node("C", text("OO") + long(1001) + long(link), 3))]
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", version)
    for one in top:
        data += one(len(data))
    return data + bytes(13) + bytes(160)


def make_collada():
    t = collada()
    ok = lambda name, data: case("collada_ok_%s.dae" % name, data, OK)
    bad = lambda name, data, message: case("collada_%s.dae" % name, data, UNREADABLE, message)
    ok("plain", t)
    ok("crlf", t.replace("\n", "\r\n"))
    ok("z_up", collada(up="Z_UP"))
    ok("up_is_nonsense", collada(up="SIDEWAYS"))
    ok("twice_as_large", collada(node="<scale>2 2 2</scale>"))
    ok("mirrored", collada(node="<scale>-1 1 1</scale>"))
    ok("byte_order_mark", "\xef\xbb\xbf" + t)
    ok("comments", t.replace("<scene>", "<!-- <scene> -->\n<scene>"))
    ok("polylist", collada(prim='<polylist count="4"><input semantic="VERTEX" source="#v" offset="0"/>'
                           '<vcount>3 3 3 3</vcount><p>%s</p></polylist>' % " ".join(str(v) for f in F4 for v in f)))
    ok("unknown_elements", t.replace("<scene>", "<extra><technique profile='x'><a><b/></a></technique></extra><scene>"))
    ok("entity_nobody_uses", t.replace("<COLLADA", "<!DOCTYPE a [<!ENTITY b 'c'>]>\n<COLLADA"))
    bad("empty", "", "the file is empty")
    bad("root_alone", "<COLLADA/>", "")
    bad("html", "<html><body>COLLADA</body></html>", "")
    for part in (60, 200, 500, 700, len(t) - 30):
        bad("cut_%d" % part, t[:part], "")
    bad("no_scene", t[:t.index("<scene>")] + "</COLLADA>", "")
    bad("scene_of_nothing", changed(t, '<instance_geometry url="#g"/>', ""), "holds no triangles")
    bad("geometry_elsewhere", changed(t, 'url="#g"', 'url="#h"'), "holds no triangles")
    bad("geometry_in_another_file", changed(t, 'url="#g"', 'url="file:///etc/passwd#g"'), "")
    bad("scene_elsewhere", changed(t, 'url="#s"', 'url="#t"'), "")
    bad("source_elsewhere", changed(t, 'source="#p"', 'source="#q"'), "")
    bad("source_of_itself", changed(t, 'source="#a"', 'source="#p"'), "")
    bad("index_beyond", changed(t, "<p>0", "<p>4"), "")
    bad("index_huge", changed(t, "<p>0", "<p>99999999999999999999"), "")
    bad("index_is_a_word", changed(t, "<p>0", "<p>zero"), "")  # went round and round, and took all memory
    bad("too_few_indices", changed(t, "<p>0 2 1", "<p>0 2"), "")
    bad("count_huge", changed(t, '<triangles count="4"', '<triangles count="4294967295"'), "")
    bad("count_negative", changed(t, '<triangles count="4"', '<triangles count="-4"'), "")
    bad("floats_too_few", changed(t, 'count="12"', 'count="1200"'), "")
    bad("floats_count_huge", changed(t, 'count="12"', 'count="4611686018427387904"'), "")
    ok("accessor_count_nobody_needs", changed(t, 'count="4" stride', 'count="4294967295" stride'))
    case("collada_stride_0.dae", changed(t, 'stride="3"', 'stride="0"'), NO_SPHERE, "name one vertex twice")
    bad("stride_huge", changed(t, 'stride="3"', 'stride="4294967295"'), "")
    bad("offset_huge", changed(t, 'offset="0"', 'offset="4294967295"'), "")
    bad("nan", changed(t, "1 1 1", "nan 1 1"), "")
    bad("scale_nan", collada(node="<scale>nan 1 1</scale>"), "")
    bad("scale_huge", collada(node="<scale>1e30 1e30 1e30</scale>" * 2), "")
    bad("node_of_itself", collada(nodes='<library_nodes><node id="l"><instance_node url="#l"/></node></library_nodes>',
                                  scene='<instance_node url="#l"/>'), "")
    ok("deep", collada(node="<node>" * 3000, scene='<instance_geometry url="#g"/>' + "</node>" * 3000))
    bad("lines_alone", collada(prim='<lines count="2"><input semantic="VERTEX" source="#v" offset="0"/>'
                               '<p>0 1 2 3</p></lines>'), "")
    bad("billion_laughs", "<?xml version='1.0'?><!DOCTYPE a [<!ENTITY a '1 1 1 1 1 1 1 1 1 1'>" +
        "".join("<!ENTITY %s '%s'>" % (chr(98 + i), ("&%s;" % chr(97 + i)) * 10) for i in range(9)) + "]>" +
        changed(t[t.index("<COLLADA"):], ">1 1 1", ">&j; 1 1 1"), "")
    bad("external_entity", "<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]>" +
        changed(t[t.index("<COLLADA"):], ">1 1 1", ">&x; 1 1"), "")
    bad("bad_tags", t.replace("</mesh>", "</mush>"), "")
    bad("noise", t[:300] + "".join(chr(33 + i * 37 % 90) for i in range(3000)) + t[300:], "")


def make_fbx():
    t, b = fbx(), binary_fbx()
    ok = lambda name, data: case("fbx_ok_%s.fbx" % name, data, OK)
    bad = lambda name, data, message: case("fbx_%s.fbx" % name, data, UNREADABLE, message)
    ok("ascii", t)
    ok("binary", b)
    ok("crlf", t.replace("\n", "\r\n"))
    ok("z_up", fbx(up=2))
    ok("up_is_nonsense", fbx(up=7))
    ok("packed", binary_fbx(vertices=array("d", [float(c) for p in P4 for c in p], packed=True)))
    ok("floats", binary_fbx(vertices=array("f", [float(c) for p in P4 for c in p])))
    ok("version_7500_by_words_alone", fbx(version=7500))
    bad("empty", "", "the file is empty")
    bad("magic_only", "; FBX 7.4.0 project file\n", "")
    bad("binary_magic_only", b[:23], "")
    bad("binary_header_only", b[:27], "")
    for part in (30, 60, 100, 300, len(b) - 200):
        bad("binary_cut_%d" % part, b[:part], "")
    for part in (100, 300, 500, len(t) - 40):
        bad("ascii_cut_%d" % part, t[:part], "")
    bad("version_1", fbx(version=1), "")
    bad("version_5000", fbx(version=5000), "")
    bad("no_objects", t[:t.index("Objects:")], "")
    bad("no_vertices", changed(t, "Vertices:", "Vortices:"), "")
    bad("no_indices", changed(t, "PolygonVertexIndex:", "PolygonIndex:"), "")
    bad("index_beyond", fbx(faces=[(0, 2, 9)] + F4[1:]), "")
    bad("index_huge", changed(t, "a: 0,2,", "a: 99999999999,2,"), "")
    bad("index_is_a_word", changed(t, "a: 0,2,", "a: x,2,"), "")
    case("fbx_no_last_corner.fbx", changed(t, ",-4\n", ",3\n"), NO_SPHERE, "not closed")
    bad("vertex_count_huge", fbx(count=2**31 - 1), "")
    bad("vertex_count_negative", fbx(count=-3), "")
    bad("two_coordinates", changed(t, "a: 1,1,1,", "a: 1,1,"), "")
    bad("nan", changed(t, "a: 1,1,1,", "a: nan,1,1,"), "")
    bad("quote_without_end", changed(t, '"Mesh" {', '"Mesh {'), "")
    bad("braces_deep", changed(t, "Objects:  {", "Objects:  {" + "A: {" * 3000), "")
    bad("not_connected", changed(t, '"OO",1001,1002', '"OO",1001,1003'), "")
    bad("binary_not_connected", binary_fbx(link=1003), "")
    bad("array_longer_than_the_file", binary_fbx(vertices=array("d", [0.0] * 12, length=2**31 - 1)), "")
    bad("array_bytes_beyond", binary_fbx(vertices=array("d", [0.0] * 12, size=2**31 - 1)), "")
    bad("packed_garbage", binary_fbx(vertices=b"d" + struct.pack("<III", 12, 1, 20) + b"\x78\x9c" + b"x" * 18), "")
    bad("packed_bomb", binary_fbx(vertices=b"d" + struct.pack("<III", 12, 1, len(zlib.compress(bytes(8 << 20), 9))) +
                                  zlib.compress(bytes(8 << 20), 9)), "")
    bad("unknown_type", binary_fbx(vertices=b"Z" + struct.pack("<III", 12, 0, 0)), "")
    bad("words_as_numbers", binary_fbx(indices=text("abc")), "")
    bad("record_ends_before_it_begins", b[:27] + struct.pack("<I", 3) + b[31:], "")
    bad("record_ends_beyond", b[:27] + struct.pack("<I", 2**32 - 1) + b[31:], "")
    bad("version_beyond", b[:23] + struct.pack("<I", 99999) + b[27:], "")
    bad("zeros", b[:27] + bytes(2000), "")
    bad("ones", b[:27] + b"\xff" * 2000, "")


def chunk(kind, data):
    return struct.pack("<HI", kind, len(data) + 6) + data


def three_ds(points=P4, faces=F4):
    vertices = struct.pack("<H", len(points)) + b"".join(struct.pack("<fff", *p) for p in points)
    corners = struct.pack("<H", len(faces)) + b"".join(struct.pack("<HHHH", *f, 7) for f in faces)
    mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, corners))
    return chunk(0x4D4D, chunk(2, struct.pack("<I", 3)) + chunk(0x3D3D, chunk(0x4000, b"t\0" + mesh)))


def make_three_ds():
    t = three_ds()
    bad = lambda name, data, message: case("three_ds_%s.3ds" % name, data, UNREADABLE, message)
    case("three_ds_ok_plain.3ds", t, OK)
    case("three_ds_ok_by_content.bin", t, OK)
    case("three_ds_open.3ds", three_ds(faces=F4[:3]), NO_SPHERE, "not closed")
    bad("words", "hello", "")
    for part in (8, 40, len(t) - 30):
        bad("cut_%d" % part, t[:part], "")
    case("three_ds_ok_vertex_beyond.3ds", three_ds(faces=F4[:3] + [(1, 2, 9)]), OK)  # as assimp mends it, and warns
    bad("nan", three_ds(points=P4[:3] + [(float("nan"), 0, 0)]), "")
    bad("no_meshes", chunk(0x4D4D, chunk(2, struct.pack("<I", 3)) + chunk(0x3D3D, b"")), "")


def make_x3d():
    t = ("<?xml version='1.0'?><X3D version='3.0'><Scene><Shape><IndexedFaceSet coordIndex='%s'><Coordinate point='%s'/>"
         "</IndexedFaceSet></Shape></Scene></X3D>" % (" ".join("%d %d %d -1" % f for f in F4),
                                                      " ".join("%d %d %d" % p for p in P4)))
    bad = lambda name, data, message: case("x3d_%s.x3d" % name, data, UNREADABLE, message)
    case("x3d_ok_plain.x3d", t, OK)
    bad("root_alone", "<X3D/>", "")
    bad("cut", t[:150], "")
    bad("bad_tags", t.replace("</Shape>", "</Shap>"), "")
    bad("no_points", changed(t, "<Coordinate", "<Coordinates"), "")
    bad("external_entity", "<!DOCTYPE a [<!ENTITY x SYSTEM 'file:///etc/passwd'>]>" +
        changed(t, "point='1", "point='&x; 1")[21:], "")


def make_all():
    make_collada()
    make_fbx()
    make_three_ds()
    make_x3d()
