"""STL, glTF, GLB and GIFTI, each wrong in one way or odd and right."""
import base64
import json
import struct
import zlib

from corpus import *


# --- STL ---------------------------------------------------------------------------------------

def facet(corners):
    return ("facet normal 0 0 1\nouter loop\n" + "".join("vertex %s %s %s\n" % tuple(c) for c in corners) +
            "endloop\nendfacet\n")


def stl(points, faces):
    return "solid a\n" + "".join(facet([points[v] for v in f]) for f in faces) + "endsolid a\n"


def binary_stl(points, faces, header=b"made by hand", attribute=0):
    data = header.ljust(80, b"\0") + struct.pack("<I", len(faces))
    for f in faces:
        data += struct.pack("<12fH", 0, 0, 1, *[c for v in f for c in points[v]], attribute)
    return data


def make_stl():
    t, b = stl(P4, F4), binary_stl(P4, F4)
    ok = lambda name, data: case("stl_ok_%s.stl" % name, data, OK)
    bad = lambda name, data, message: case("stl_%s.stl" % name, data, UNREADABLE, message)
    ok("ascii", t)
    ok("ascii_upper_case", t.upper())
    ok("ascii_crlf", t.replace("\n", "\r\n"))
    ok("ascii_indented", t.replace("\n", "\n\t  "))
    ok("ascii_two_solids", changed(t, facet([P4[v] for v in F4[1]]), "endsolid\nsolid b\n" +
                                   facet([P4[v] for v in F4[1]])))
    ok("ascii_trailing_words", t + "that is all\n")
    ok("ascii_zeros_behind", t + 100 * "\0")
    ok("ascii_normals_without_numbers", t.replace("normal 0 0 1", "normal -nan(ind) nan -1.#IND"))
    ok("binary", b)
    ok("binary_that_says_solid", binary_stl(P4, F4, b"solid a"))
    ok("binary_that_says_solid_and_newline", binary_stl(P4, F4, b"solid a\nfacet normal"))
    ok("binary_attributes", binary_stl(P4, F4, attribute=65535))
    bad("empty_name", "solid", "found the end of the file")
    bad("cut_in_facet", t[:t.index("endloop")], "expected 'endloop'")
    bad("no_endsolid", t[:t.index("endsolid")], "found the end of the file")
    bad("two_corners", changed(t, "vertex 1 1 1\n", ""), "expected 'vertex'")
    bad("four_corners", changed(t, "endloop", "vertex 0 0 0\nendloop"), "more than 3 corners")
    bad("two_coordinates", changed(t, "vertex 1 1 1", "vertex 1 1"), "expected a number")
    bad("normal_of_two", changed(t, "normal 0 0 1", "normal 0 0"), "expected a number")
    bad("no_normal", changed(t, "facet normal 0 0 1", "facet"), "expected 'normal'")
    bad("no_outer_loop", changed(t, "outer loop\n", ""), "expected 'outer'")
    bad("unknown_word", changed(t, "facet", "face"), "expected 'facet', found 'face'")
    for word in ("nan", "inf", "1e999", "1,0", "0x1"):
        bad("number_" + word.replace(",", "_"), changed(t, "vertex 1 1 1", "vertex 1 1 " + word), "expected a number")
    bad("ascii_nul", changed(t, "1 1 1", "1 1 \0001"), "binary STL of")
    for size in (0, 1, 79, 80, 83):
        bad("binary_of_%d_bytes" % size, b[:size], "the file is empty" if size == 0 else "")
    for size in (84, 85, 134, len(b) - 1):
        bad("binary_of_%d_bytes" % size, b[:size], "binary STL of 4 triangles has 284 bytes")
    ok("binary_zero_behind", b + b"\0")
    bad("binary_triangle_behind", b + b[84:134], "this file has 334")
    for count in (3, 5, 2**31 - 1, 2**32 - 1):
        bad("binary_count_%d" % count, b[:80] + struct.pack("<I", count) + b[84:], "binary STL of %d triangles" % count)
    for name, value in (("nan", float("nan")), ("inf", float("inf"))):
        bad("binary_" + name, b[:96] + struct.pack("<f", value) + b[100:], "byte 96: coordinate is not a finite number")
    case("stl_no_facets.stl", "solid a\nendsolid a\n", NO_SPHERE, "no faces")
    case("stl_binary_no_facets.stl", b[:80] + bytes(4), NO_SPHERE, "no faces")
    case("stl_open.stl", stl(P4, F4[1:]), NO_SPHERE, "boundary edge")
    case("stl_facet_of_one_point.stl", stl(P4 + [(9, 9, 9)], F4 + [(4, 4, 4)]), NO_SPHERE, "")
    case("stl_facet_of_two_points.stl", binary_stl(P4, F4 + [(0, 0, 1)]), NO_SPHERE, "")
    case("stl_facet_twice.stl", binary_stl(P4, F4 + F4[:1]), NO_SPHERE, "same three vertices")


# --- glTF --------------------------------------------------------------------------------------

INDEX_BYTES = struct.pack("<12H", *[v for f in F4 for v in f])
POINT_BYTES = struct.pack("<12f", *[c for p in P4 for c in p])
BUFFER = POINT_BYTES + INDEX_BYTES


def document():
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, -1],
                           "max": [1, 1, 1]},
                          {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
            "buffers": [{"byteLength": 72}]}


def chunk(kind, data, pad):
    data += pad * (-len(data) % 4)
    return struct.pack("<I", len(data)) + kind + data


def glb(doc, buffer=BUFFER):
    text = doc if isinstance(doc, bytes) else json.dumps(doc).encode()
    body = chunk(b"JSON", text, b" ") + (chunk(b"BIN\0", buffer, b"\0") if buffer is not None else b"")
    return b"glTF" + struct.pack("<II", 2, 12 + len(body)) + body


def edited(*path_and_value, base=None):
    doc = base or document()
    *path, value = path_and_value
    at = doc
    for step in path[:-1]:
        at = at[step]
    if value is None:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return doc


def gltf(uri, doc=None):
    doc = doc or document()
    doc["buffers"][0]["uri"] = uri
    return json.dumps(doc)


DATA_URI = "data:application/octet-stream;base64," + base64.b64encode(BUFFER).decode()


def sparse(index_bytes, count, values=3, index_type=5121):
    doc = document()
    doc["accessors"][0]["sparse"] = {"count": count, "indices": {"bufferView": 2, "componentType": index_type},
                                     "values": {"bufferView": 3}}
    doc["bufferViews"] += [{"buffer": 0, "byteOffset": 72, "byteLength": max(1, len(index_bytes))},
                           {"buffer": 0, "byteOffset": 76, "byteLength": 12 * values}]
    doc["buffers"][0]["byteLength"] = 76 + 12 * values
    return glb(doc, BUFFER + index_bytes.ljust(4, b"\0") + struct.pack("<%df" % (3 * values), *([2.0] * 3 * values)))


def make_compressed_glb():
    """Extensions that claim what their bytes do not hold."""
    bad = lambda name, data, message="": case("glb_%s.glb" % name, data, UNREADABLE, message)
    said = {"buffer": 0, "byteLength": 48, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}

    def meshopt(name, message, **changes):
        doc = edited("bufferViews", 0, "extensions", {"EXT_meshopt_compression": {**said, **changes}})
        bad("meshopt_" + name, glb(doc), message)

    meshopt("of_no_meshopt", "damaged")
    meshopt("count_2_to_31", "more rows than its bytes can hold", count=2**31)
    meshopt("count_2_to_60", "no whole number", count=2**60)
    meshopt("count_zero", "more rows", count=0)
    meshopt("stride_zero", "rows of 0 bytes", byteStride=0)
    meshopt("stride_260", "rows of 260 bytes", byteStride=260)
    meshopt("beyond_the_buffer", "past the end", byteOffset=60)
    meshopt("buffer_that_is_not_there", "buffer that is not there", buffer=3)
    meshopt("mode_unheard_of", "mode 'X'", mode="X")
    bad("meshopt_no_object", glb(edited("bufferViews", 0, "extensions", {"EXT_meshopt_compression": 7})), "compression")

    def draco(name, packed, message, attributes={"POSITION": 0}):
        doc = document()
        doc["bufferViews"].append({"buffer": 0, "byteOffset": len(BUFFER), "byteLength": len(packed)})
        doc["buffers"][0]["byteLength"] = len(BUFFER) + len(packed)
        doc["meshes"][0]["primitives"][0]["extensions"] = {
            "KHR_draco_mesh_compression": {"bufferView": len(doc["bufferViews"]) - 1, "attributes": attributes}}
        bad("draco_" + name, glb(doc, BUFFER + packed), message)

    header = b"DRACO\2\2\1\1\0\0"
    draco("of_no_draco", b"no Draco at all.", "not 2.2")
    draco("header_only", header, "Draco says")
    draco("claims_2_to_28_faces", header + b"\0\4" + b"\x80\x80\x80\x80\1" + b"\0" * 20, "more triangles than its bytes")
    draco("sequential_claims_2_to_28_faces", header[:8] + b"\0\0\0" + b"\x80\x80\x80\x80\1" + b"\4" + b"\0" * 20,
          "more triangles than its bytes")
    draco("claims_2_to_28_faces_after_metadata",
          header[:9] + b"\0\x80" + b"\0\0\0" + b"\0\4" + b"\x80\x80\x80\x80\1" + b"\0" * 20,
          "more triangles than its bytes")
    draco("version_1_3", b"DRACO\1\3\1\1\0\0" + b"\0" * 20, "is Draco 1.3, not 2.2")
    draco("attributes_are_a_list", header, "no attributes", attributes=[0])


def make_glb():
    b = glb(document())
    ok = lambda name, data: case("glb_ok_%s.glb" % name, data, OK)
    bad = lambda name, data, message="": case("glb_%s.glb" % name, data, UNREADABLE, message)
    wrong = lambda name, *path_and_value, message="": bad(name, glb(edited(*path_and_value)), message)
    ok("plain", b)
    ok("data_after_the_end", b + b"\0\0\0\0")
    for spaces in range(4):  # chunks without their padding, one of them with a length that is right
        text = json.dumps(document()).encode() + b" " * spaces
        bare = struct.pack("<I", len(text)) + b"JSON" + text + chunk(b"BIN\0", BUFFER, b"\0")
        ok("unpadded_%d" % spaces, b[:8] + struct.pack("<I", 12 + len(bare)) + bare)
    bad("unpadded_before_garbage", b[:8] + struct.pack("<I", 12 + len(bare) + 9) + bare + b"123456789")
    ok("unknown_chunk", b[:8] + struct.pack("<I", len(b) + 12) + b[12:] + chunk(b"ABCD", b"1234", b"\0"))
    ok("unused_extension", glb(edited("extensionsUsed", ["EXT_unheard_of"])))
    ok("sparse", sparse(b"\0\1", 1, 1))
    ok("scaled", glb(edited("nodes", 0, "scale", [1e-3, 2, 1e3])))
    ok("mirrored", glb(edited("nodes", 0, "scale", [-1, 1, 1])))
    ok("image_that_is_not_there", glb(edited("images", [{"uri": "../../etc/passwd"}])))
    bad("magic_only", b[:4], "too short")
    bad("header_only", b[:12])
    bad("cut_in_json", b[:100], "the file has 100")
    bad("cut_in_buffer", b[:-1])
    bad("version_1", b[:4] + struct.pack("<I", 1) + b[8:], "is binary glTF 1, which is not supported")
    bad("version_3", b[:4] + struct.pack("<I", 3) + b[8:], "is binary glTF 3")
    for length in (0, 11, 12, 19, 20, len(b) - 4, len(b) + 4, 2**31, 2**32 - 1):
        bad("length_%d" % length, b[:8] + struct.pack("<I", length) + b[12:])
    for length in (0, 1, 2**31, 2**32 - 4, 2**32 - 1):
        bad("json_chunk_%d" % length, b[:12] + struct.pack("<I", length) + b[16:])
    bad("first_chunk_no_json", b[:16] + b"BIN\0" + b[20:], "the first chunk is no JSON")
    bad("no_buffer_chunk", glb(document(), None))
    bad("json_garbage", glb(b"{]"), "JSON")
    bad("json_array", glb(b"[]"))
    bad("json_number", glb(b"7"))
    bad("json_empty", glb(b""))
    bad("json_unclosed", glb(b'{"asset":'))
    bad("json_deep", glb(b'{"asset":{"version":"2.0"},"extras":' + b"[" * 5000 + b"]" * 5000 + b"}"), "nested deeper")
    bad("json_nul", glb(json.dumps(document()).encode().replace(b'"2.0"', b'"2\0.0"')))
    bad("json_bad_utf8", glb(json.dumps(document()).encode().replace(b'"2.0"', b'"2.0\xff\xfe"')))
    wrong("no_asset", "asset", None, message="asset.version is missing")
    wrong("asset_version_1", "asset", "version", "1.0", message="glTF '1.0'")
    wrong("requires_EXT_unheard_of", "extensionsRequired", ["EXT_unheard_of"],
          message="requires the extension 'EXT_unheard_of'")
    for extension in ("KHR_draco_mesh_compression", "EXT_meshopt_compression"):
        ok("requires_but_does_not_use_" + extension, glb(edited("extensionsRequired", [extension])))
    wrong("no_meshes", "meshes", [])
    wrong("no_primitives", "meshes", 0, "primitives", [])
    wrong("primitive_without_positions", "meshes", 0, "primitives", 0, "attributes", {"NORMAL": 0})
    wrong("primitive_of_lines", "meshes", 0, "primitives", 0, "mode", 1, message="lines")
    wrong("primitive_of_points", "meshes", 0, "primitives", 0, "mode", 0, message="points")
    wrong("primitive_mode_7", "meshes", 0, "primitives", 0, "mode", 7)
    wrong("primitive_mode_negative", "meshes", 0, "primitives", 0, "mode", -1)
    for value in (-1, 2, 2**31 - 1, 2**31, 2**40, 1e300, "a", True, [0], 0.5):
        tag = str(value).replace("[", "").replace("]", "").replace(".", "_").replace("-", "minus")
        tag = tag if not isinstance(value, list) else "list_" + tag
        wrong("position_accessor_" + tag, "meshes", 0, "primitives", 0, "attributes", "POSITION", value)
        wrong("view_of_accessor_" + tag, "accessors", 0, "bufferView", value)
        if value != 2:
            wrong("count_" + tag, "accessors", 0, "count", value)
    wrong("index_accessor_beyond", "meshes", 0, "primitives", 0, "indices", 9, message="primitive indices accessor out of bounds")
    wrong("count_zero", "accessors", 0, "count", 0)
    wrong("count_five_of_four", "accessors", 0, "count", 5, message="do not fit into the buffer view")
    wrong("index_count_11", "accessors", 1, "count", 11, message="no whole triangles")
    wrong("component_type_0", "accessors", 0, "componentType", 0)
    wrong("component_type_unknown", "accessors", 0, "componentType", 5127)
    ok("positions_of_bytes", glb(edited("accessors", 0, "componentType", 5120)))
    wrong("positions_of_two", "accessors", 0, "type", "VEC2")
    wrong("positions_of_matrices", "accessors", 0, "type", "MAT4")
    wrong("positions_of_strings", "accessors", 0, "type", "VEC5")
    wrong("indices_of_floats", "accessors", 1, "componentType", 5126)
    wrong("indices_of_vectors", "accessors", 1, "type", "VEC3")
    for value in (-4, 1, 2, 4, 72, 2**31, 2**63):
        wrong("accessor_offset_%s" % str(value).replace("-", "minus"), "accessors", 0, "byteOffset", value)
    for value in (-1, 25, 48, 72, 2**32, 2**63 - 1):
        wrong("view_offset_%s" % str(value).replace("-", "minus"), "bufferViews", 0, "byteOffset", value)
    for value in (-1, 0, 47, 73, 2**32, 2**63 - 1):
        wrong("view_length_%s" % str(value).replace("-", "minus"), "bufferViews", 0, "byteLength", value)
    for value in (-12, 2, 3, 11, 13, 253, 256, 2**31):
        wrong("view_stride_%s" % str(value).replace("-", "minus"), "bufferViews", 0, "byteStride", value)
    wrong("view_of_no_buffer", "bufferViews", 0, "buffer", 1)
    wrong("buffer_longer_than_its_chunk", "buffers", 0, "byteLength", 4096)
    wrong("buffer_length_negative", "buffers", 0, "byteLength", -1)
    wrong("buffer_length_huge", "buffers", 0, "byteLength", 2**53)
    index = lambda value: POINT_BYTES + struct.pack("<H", value) + INDEX_BYTES[2:]
    bad("index_beyond", glb(document(), index(4)), "names vertex 4 of 4")
    bad("index_restart", glb(document(), index(65535)), "names vertex 65535 of 4")
    for name, value in (("nan", float("nan")), ("inf", float("-inf"))):
        bad(name, glb(document(), struct.pack("<f", value) + BUFFER[4:]), "is no finite number")
    bad("sparse_beyond", sparse(b"\4", 1, 1), "sparse index is out of range")
    bad("sparse_not_increasing", sparse(b"\2\1", 2, 2), "do not increase")
    bad("sparse_twice", sparse(b"\1\1", 2, 2), "do not increase")
    bad("sparse_too_many", sparse(b"\0\1\2\3", 5, 3))
    bad("sparse_none", sparse(b"", 0, 1))
    bad("sparse_negative", sparse(b"", -1, 1))
    bad("sparse_float_indices", sparse(b"\0\0\0\0", 1, 1, 5126), "no unsigned integers")
    bad("sparse_values_missing", sparse(b"\0\1\2\3", 4, 1))
    wrong("node_cycle", "nodes", [{"mesh": 0, "children": [1]}, {"children": [0]}])
    wrong("node_its_own_child", "nodes", [{"mesh": 0, "children": [0]}], message="two parents")
    wrong("node_twice", "nodes", [{"children": [1, 1]}, {"mesh": 0}], message="node 1 has two parents")
    wrong("node_beyond", "nodes", [{"mesh": 0, "children": [7]}], message="node 7 is not there")
    wrong("node_of_no_mesh", "nodes", [{"mesh": 3}], message="mesh 3 is not there")
    wrong("scene_beyond", "scene", 5, message="scene 5 is not there")
    wrong("scene_of_no_node", "scenes", 0, "nodes", [4])
    wrong("scene_of_nothing", "scenes", 0, "nodes", [])
    wrong("matrix_of_three", "nodes", 0, "matrix", [1, 0, 0])
    wrong("matrix_of_zeros", "nodes", 0, "matrix", [0] * 15 + [1], message="singular")
    wrong("matrix_projective", "nodes", 0, "matrix", [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1], message="not affine")
    wrong("scale_zero", "nodes", 0, "scale", [1, 0, 1], message="singular")
    wrong("scale_overflows", "nodes", 0, "scale", [1e300, 1e300, 1e300])
    wrong("rotation_zero", "nodes", 0, "rotation", [0, 0, 0, 0], message="its rotation is zero")
    wrong("attribute_of_another_count", "meshes", 0, "primitives", 0, "attributes",
          {"POSITION": 0, "_ID": 1})
    deep = [{"children": [i + 1]} for i in range(300)] + [{"mesh": 0}]
    ok("three_hundred_nodes_deep", glb(edited("nodes", deep)))


def make_gltf():
    bad = lambda name, data, message="": case("gltf_%s.gltf" % name, data, UNREADABLE, message)
    case("gltf_ok_data_uri.gltf", gltf(DATA_URI), OK)
    case("gltf_ok_blanks_first.gltf", "\n\t " + gltf(DATA_URI), OK)
    missing, absolute, scheme = "No such file", "an absolute path", "a scheme other than base64 data"
    control, backslash, percent = "a control character", "a backslash", "a percent sign that two hexadecimal"
    undecoded = "Failed to decode 'uri'"
    for name, uri, message in (
            ("parent", "../secret.bin", "'..'"), ("parent_inside", "a/../../secret.bin", "'..'"),
            ("absolute", "/etc/passwd", absolute), ("percent_parent", "%2e%2e/secret.bin", "'..'"),
            ("percent_absolute", "%2Fetc%2Fpasswd", absolute), ("percent_slash", "..%2fsecret.bin", "'..'"),
            ("percent_twice", "%252e%252e/secret.bin", missing), ("percent_nul", "a%00.bin", control),
            ("percent_cut", "a%2", percent), ("percent_no_hex", "a%zz", percent),
            ("backslash", "..\\secret.bin", backslash), ("percent_backslash", "..%5csecret.bin", backslash),
            ("file_scheme", "file:///etc/passwd", scheme), ("http_scheme", "http://localhost/a.bin", scheme),
            ("pipe", "|id", missing), ("shell", "$(id)", missing), ("backquote", "`id`", missing),
            ("tilde", "~/a.bin", missing), ("glob", "*.obj", missing), ("device", "/dev/zero", absolute),
            ("proc", "/proc/self/environ", absolute), ("itself", ".", "no regular file"),
            ("folder", "./", "no regular file"), ("missing", "missing.bin", missing), ("newline", "a\nb.bin", control),
            ("long", "a" * 5000, "File name too long"), ("own_text", "gltf_uri_own_text.gltf/x", "Not a directory"),
            ("wrong_type", "data:text/plain;base64,AAAA", "data URI of an unknown type"),
            ("no_base64", "data:application/octet-stream,abcd", "data URI of an unknown type"),
            ("bad_base64", "data:application/octet-stream;base64,####", undecoded),
            ("short_base64", "data:application/octet-stream;base64,AAAA", undecoded),
            ("empty_base64", "data:application/octet-stream;base64,", undecoded)):
        bad("uri_" + name, gltf(uri), message)
    bad("no_uri", json.dumps(document()), "neither a URI nor a binary chunk")
    bad("empty_object", "{}", "asset.version is missing")
    bad("cut", gltf(DATA_URI)[:200], "")
    bad("not_json", "{ this is not json }")
    bad("two_documents", gltf(DATA_URI) * 2)
    bad("numbers_overflow", gltf(DATA_URI).replace('"count": 12', '"count": 1e400'))
    case("gltf_ok_keys_twice.gltf", gltf(DATA_URI).replace('"count": 4', '"count": 4000000000, "count": 4'), OK)
    bad("words", "hello", "is no glTF")


# --- GIFTI -------------------------------------------------------------------------------------

def data_array(intent, kind, rows, data, encoding="ASCII", more="", endian="LittleEndian"):
    return ('<DataArray Intent="NIFTI_INTENT_%s" DataType="NIFTI_TYPE_%s" ArrayIndexingOrder="RowMajorOrder" '
            'Dimensionality="2" Dim0="%s" Dim1="3" Encoding="%s" Endian="%s" ExternalFileName="" '
            'ExternalFileOffset="0"%s><Data>%s</Data></DataArray>\n' % (intent, kind, rows, encoding, endian, more, data))


def numbers(rows):
    return " ".join(str(n) for row in rows for n in row)


def packed(code, rows, order="<", squeeze=False):
    data = struct.pack(order + str(3 * len(rows)) + code, *[n for row in rows for n in row])
    return base64.b64encode(zlib.compress(data) if squeeze else data).decode()


def gifti(points=None, triangles=None, count=2, prologue='<?xml version="1.0" encoding="UTF-8"?>\n', version="1.0"):
    points = points if points is not None else data_array("POINTSET", "FLOAT32", 4, numbers(P4))
    triangles = triangles if triangles is not None else data_array("TRIANGLE", "INT32", 4, numbers(F4))
    return prologue + '<GIFTI Version="%s" NumberOfDataArrays="%d">\n' % (version, count) + points + triangles + "</GIFTI>\n"


VOLUME = {"VolGeom" + key: value for key, value in {
    "Width": 256, "Height": 256, "Depth": 256, "Xsize": 1, "Ysize": 1, "Zsize": 1, "X_R": -1, "X_A": 0, "X_S": 0,
    "Y_R": 0, "Y_A": 0, "Y_S": -1, "Z_R": 0, "Z_A": 1, "Z_S": 0, "C_R": 0.5, "C_A": -1.25, "C_S": 3,
    "Fname": "../mri/filled.mgz"}.items()}


def of_volume(**other):
    """A surface that says which volume it is of."""
    said = {**VOLUME, **{"VolGeom" + key: value for key, value in other.items()}}
    lines = "".join("<MD><Name>%s</Name><Value>%s</Value></MD>" % line for line in said.items() if line[1] is not None)
    return changed(gifti(), "<Data>", "<MetaData>%s</MetaData><Data>" % lines)


def make_gifti():
    t = gifti()
    ok = lambda name, data: case("gifti_ok_%s.gii" % name, data, OK)
    bad = lambda name, data, message="": case("gifti_%s.gii" % name, data, UNREADABLE, message)
    points = lambda *a, **k: gifti(points=data_array("POINTSET", *a, **k))
    triangles = lambda *a, **k: gifti(triangles=data_array("TRIANGLE", *a, **k))
    ok("ascii", t)
    ok("base64", points("FLOAT32", 4, packed("f", P4), "Base64Binary"))
    ok("base64_big_endian", points("FLOAT32", 4, packed("f", P4, ">"), "Base64Binary", endian="BigEndian"))
    ok("compressed", points("FLOAT32", 4, packed("f", P4, squeeze=True), "GZipBase64Binary"))
    ok("doubles", points("FLOAT64", 4, packed("d", P4), "Base64Binary"))
    ok("document_type", gifti(prologue='<?xml version="1.0"?>\n<!DOCTYPE GIFTI SYSTEM "http://localhost/gifti.dtd">\n'))
    ok("volume", of_volume())
    ok("volume_not_all_there", of_volume(C_S=None))
    ok("volume_of_words", of_volume(C_S="far away"))
    ok("volume_of_no_number", of_volume(C_S="nan"))
    ok("volume_of_lines", of_volume(Fname="a\nb\n\n", C_S="1\n"))
    ok("volume_of_no_name", of_volume(Fname=None))
    ok("volume_huge", of_volume(Width="9" * 400, Fname="n" * 9000))
    ok("triangles_first", gifti(data_array("TRIANGLE", "INT32", 4, numbers(F4)),
                                data_array("POINTSET", "FLOAT32", 4, numbers(P4))))
    bad("entity", gifti(prologue='<?xml version="1.0"?>\n<!DOCTYPE GIFTI [<!ENTITY a "b">]>\n'), "declares an entity")
    laughs = "".join('<!ENTITY l%d "%s">' % (i, "&l%d;" % (i - 1) * 10) for i in range(1, 10))
    bad("billion_laughs", gifti(prologue='<?xml version="1.0"?>\n<!DOCTYPE GIFTI [<!ENTITY l0 "ha">%s]>\n' % laughs),
        "declares an entity")
    bad("external_entity", gifti(prologue='<?xml version="1.0"?>\n<!DOCTYPE GIFTI [<!ENTITY x SYSTEM "file:///etc/passwd">]>\n'),
        "declares an entity")
    bad("undeclared_entity", changed(t, "<Data>", "<Data>&x;"))
    bad("external_file", changed(t, 'ExternalFileName=""', 'ExternalFileName="/etc/passwd"'), "in another file")
    bad("external_encoding", changed(t, 'Encoding="ASCII"', 'Encoding="ExternalFileBinary"'), "in another file")
    bad("unclosed", t[:-9], "malformed XML")
    bad("cut_in_data", t[:t.index("</Data>")], "malformed XML")
    bad("cut_in_tag", t[:60], "malformed XML")
    bad("nul", changed(t, "<Data>", "<Data>\0"))
    bad("bad_utf8", changed(t, "<Data>", "<Data>\xff\xfe"), "malformed XML")
    bad("unknown_xml_encoding", changed(t, "UTF-8", "UTF-99"))
    bad("two_roots", t + "<GIFTI/>", "malformed XML")
    bad("gifti_in_gifti", changed(t, "</GIFTI>", '<GIFTI Version="1.0" NumberOfDataArrays="0"/></GIFTI>'))
    bad("deep", changed(t, "</GIFTI>", "<a>" * 2000 + "</a>" * 2000 + "</GIFTI>"), "nested deeper")
    bad("version_2", gifti(version="2.0"), "GIFTI version '2.0'")
    for count in (-1, 0, 1, 3, 2**31, 2**63):
        bad("count_%s" % str(count).replace("-", "minus"), gifti(count=count))
    bad("no_count", changed(t, ' NumberOfDataArrays="2"', ""), "NumberOfDataArrays is missing")
    bad("no_points", gifti(points="", count=1), "NIFTI_INTENT_POINTSET")
    bad("no_triangles", gifti(triangles="", count=1), "NIFTI_INTENT_TRIANGLE")
    bad("points_twice", gifti(points=data_array("POINTSET", "FLOAT32", 4, numbers(P4)) * 2, count=3), "is the second one")
    for rows in (-1, 0, 3, 5, 2**28, 2**31, 2**62, 2**63):
        tag = str(rows).replace("-", "minus")
        bad("rows_" + tag, points("FLOAT32", rows, numbers(P4)))
        if rows not in (0,):
            bad("binary_rows_" + tag, points("FLOAT32", rows, packed("f", P4), "Base64Binary"))
            bad("compressed_rows_" + tag, points("FLOAT32", rows, packed("f", P4, squeeze=True), "GZipBase64Binary"))
    bad("columns_4", changed(t, 'Dim1="3"', 'Dim1="4"'))
    bad("columns_huge", changed(t, 'Dim1="3"', 'Dim1="6148914691236517206"'))
    bad("dimensionality_0", changed(t, 'Dimensionality="2"', 'Dimensionality="0"'), "Dimensionality is not from 1 to 6")
    bad("dimensionality_7", changed(t, 'Dimensionality="2"', 'Dimensionality="7"'), "Dimensionality is not from 1 to 6")
    bad("dimensionality_3", changed(t, 'Dimensionality="2"', 'Dimensionality="3"'), "do not fit Dimensionality")
    bad("order_unknown", changed(t, "RowMajorOrder", "DiagonalOrder"), "unknown order")
    bad("encoding_unknown", changed(t, 'Encoding="ASCII"', 'Encoding="Rot13"'), "unknown encoding 'Rot13'")
    bad("endian_unknown", points("FLOAT32", 4, packed("f", P4), "Base64Binary", endian="PdpEndian"), "unknown byte order")
    bad("type_unknown", points("COMPLEX64", 4, numbers(P4)), "unsupported type")
    bad("points_of_integers", points("INT32", 4, numbers(P4)), "no real numbers")
    bad("triangles_of_reals", triangles("FLOAT32", 4, numbers(F4)), "no whole numbers")
    bad("base64_garbage", points("FLOAT32", 4, "!" + packed("f", P4)[1:], "Base64Binary"), "no base64")
    bad("base64_cut", points("FLOAT32", 4, packed("f", P4)[:-3], "Base64Binary"))
    bad("compressed_garbage", points("FLOAT32", 4, packed("f", P4), "GZipBase64Binary"), "corrupt or cut short")
    bad("compressed_cut", points("FLOAT32", 4, packed("f", P4, squeeze=True)[:16], "GZipBase64Binary"), "corrupt or cut short")
    bomb = base64.b64encode(zlib.compress(bytes(4 << 20), 9)).decode()
    bad("compressed_bomb", points("FLOAT32", 4, bomb, "GZipBase64Binary"))
    for word in ("nan", "inf", "x", "1,0", "1e400"):
        bad("number_" + word.replace(",", "_"), points("FLOAT32", 4, changed(numbers(P4), "1", word)))
    bad("binary_nan", points("FLOAT32", 4, packed("f", [(float("nan"), 0, 0)] + P4[1:]), "Base64Binary"), "not finite")
    bad("number_missing", points("FLOAT32", 4, numbers(P4)[:-3]), "fewer numbers")
    bad("number_too_many", points("FLOAT32", 4, numbers(P4) + " 7"), "more numbers")
    bad("index_beyond", triangles("INT32", 4, changed(numbers(F4), "3", "4")), "names vertex 4 of 4")
    bad("index_negative", triangles("INT32", 4, changed(numbers(F4), "3", "-1")), "names vertex -1 of 4")
    bad("index_twice", triangles("INT32", 4, changed(numbers(F4), "0 2 1", "0 2 2")), "names a vertex twice")
    bad("no_data", changed(t, "<Data>" + numbers(P4) + "</Data>", ""), "has no <Data>")
    bad("data_twice", changed(t, "</Data>", "</Data><Data>1</Data>"), "second <Data>")
    bad("array_in_array", changed(t, "<Data>", "<DataArray/><Data>"))
    bad("html", "<html><body>404</body></html>")
    bad("other_xml", '<?xml version="1.0"?><svg/>', "XML")
    case("gifti_open.gii", triangles("INT32", 3, numbers(F4[1:])), NO_SPHERE, "boundary edge")


def make_all():
    make_stl()
    make_glb()
    make_compressed_glb()
    make_gltf()
    make_gifti()
