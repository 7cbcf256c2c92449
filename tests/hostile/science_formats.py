"""VTK (legacy and XML), MZ3 and FreeSurfer surfaces, each wrong in one way or odd and right."""
import base64
import gzip
import struct
import zlib

from corpus import *

POINTS = [c for p in P4 for c in p]
INDICES = [v for f in F4 for v in f]


def words(numbers):
    return " ".join(map(str, numbers))


# --- Legacy VTK --------------------------------------------------------------------------------

HEAD = "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\n"


def vtk(points=None, polygons=None, more="", faces=F4):
    points = points or "POINTS 4 float\n%s\n" % words(POINTS)
    polygons = polygons or "POLYGONS %d %d\n" % (len(faces), 4 * len(faces)) + "".join("3 %s\n" % words(f) for f in faces)
    return HEAD + points + polygons + more


def binary_vtk(count=4, size=16, more=b""):
    cells = struct.pack(">16i", *[n for f in F4 for n in (3,) + f])
    return (HEAD.replace("ASCII", "BINARY").encode() + b"POINTS %d double\n" % count + struct.pack(">12d", *POINTS) +
            b"\nPOLYGONS 4 %d\n" % size + cells + b"\n" + more)


def make_vtk():
    t = vtk()
    ok = lambda name, data: case("vtk_ok_%s.vtk" % name, data, OK)
    bad = lambda name, data, message="": case("vtk_%s.vtk" % name, data, UNREADABLE, message)
    ok("plain", t)
    ok("crlf", t.replace("\n", "\r\n"))
    ok("lower_case", t.replace("ASCII", "ascii").replace("POINTS", "points").replace("DATASET", "dataset"))
    ok("binary", binary_vtk())
    ok("one_line", HEAD + " ".join(t[len(HEAD):].split()))
    ok("strips", vtk(polygons="TRIANGLE_STRIPS 1 7\n6 0 2 1 3 0 2\n"))
    ok("offsets", vtk(polygons="POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 6 9 12\nCONNECTIVITY vtktypeint64\n%s\n" % words(INDICES)))
    ok("vertices_and_lines", vtk(polygons="VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\n" + t[t.index("POLYGONS"):]))
    ok("metadata", vtk(more="METADATA\nINFORMATION 0\n\n"))
    ok("arrays", vtk(more="POINT_DATA 4\nSCALARS a float 1\nLOOKUP_TABLE default\n1 2 3 4\nFIELD FieldData 1\nb 2 4 int\n1 2 3 4 5 6 7 8\n"))
    ok("values_that_are_not_finite", vtk(more="POINT_DATA 4\nSCALARS a float\nLOOKUP_TABLE default\n1 nan 3 inf\n"))
    ok("strings", vtk(more="FIELD FieldData 1\ns 1 2 string\nhello%20there\n\n"))
    ok("bits", binary_vtk(more=b"POINT_DATA 4\nSCALARS a bit\nLOOKUP_TABLE default\n\xa0\n"))
    bad("first_line_only", "# vtk DataFile Version 3.0\n", "expected ASCII or BINARY")
    bad("no_encoding", changed(t, "ASCII", "EBCDIC"), "expected ASCII or BINARY")
    bad("unstructured", changed(t, "POLYDATA", "UNSTRUCTURED_GRID"), "'UNSTRUCTURED_GRID'")
    bad("no_points", HEAD + t[t.index("POLYGONS"):], "names point 0 of 0")
    bad("nothing", HEAD, "holds no points")
    bad("points_twice", changed(t, "POLYGONS", t[t.index("POINTS"):t.index("POLYGONS")] + "POLYGONS"), "second POINTS")
    bad("polygons_twice", t + t[t.index("POLYGONS"):], "second POLYGONS")
    bad("unknown_keyword", t + "SCALERS a float\n", "unknown keyword 'SCALERS'")
    bad("unknown_type", changed(t, "float", "quadruple"), "unknown type 'quadruple'")
    for count in (-1, 5, 2**28, 2**31, 2**63):
        tag = str(count).replace("-", "minus")
        bad("points_" + tag, changed(t, "POINTS 4", "POINTS %d" % count))
        bad("polygons_" + tag, changed(t, "POLYGONS 4", "POLYGONS %d" % count))
        bad("size_" + tag, changed(t, "POLYGONS 4 16", "POLYGONS 4 %d" % count))
        bad("binary_points_" + tag, binary_vtk(count=count))
        bad("binary_size_" + tag, binary_vtk(size=count))
        bad("arrays_" + tag, vtk(more="POINT_DATA 4\nFIELD FieldData %d\nb 2 4 int\n1 2 3 4 5 6 7 8\n" % (count if count > 0 else -1)))
        bad("tuples_" + tag, vtk(more="POINT_DATA %d\nSCALARS a float 256\nLOOKUP_TABLE default\n1 2 3 4\n" % count))
    bad("components_0", vtk(more="POINT_DATA 4\nSCALARS a float 0\nLOOKUP_TABLE default\n"), "0 components")
    bad("components_huge", vtk(more="POINT_DATA 4\nSCALARS a float 2147483647\nLOOKUP_TABLE default\n1\n"), "components")
    bad("degree_huge", changed(t, "3 0 2 1", "2147483647 0 2 1"), "ends before cell 0")
    bad("degree_negative", changed(t, "3 0 2 1", "-3 0 2 1"))
    bad("degree_2", changed(t, "3 0 2 1\n", "2 0 2\n").replace("4 16", "4 15"), "fewer than 3 corners")
    bad("index_beyond", changed(t, "3 0 2 1", "3 0 2 4"), "names point 4 of 4")
    bad("index_negative", changed(t, "3 0 2 1", "3 0 2 -1"), "names point -1 of 4")
    bad("index_twice", changed(t, "3 0 2 1", "3 0 2 2"), "names a vertex twice")
    bad("index_fraction", changed(t, "3 0 2 1", "3 0 2 1.5"), "expected a number")
    for word in ("nan", "inf", "1e999", "1,0", "0x1", "x"):
        bad("number_" + word.replace(",", "_"), changed(t, "1 1 1", "1 1 " + word))
    bad("offsets_fall", vtk(polygons="POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 9 6 12\nCONNECTIVITY vtktypeint64\n%s\n" % words(INDICES)), "do not fit")
    bad("offsets_beyond", vtk(polygons="POLYGONS 5 12\nOFFSETS vtktypeint64\n0 3 6 9 13\nCONNECTIVITY vtktypeint64\n%s\n" % words(INDICES)), "do not fit")
    bad("no_lookup_table", vtk(more="POINT_DATA 4\nSCALARS a float\n1 2 3 4\n"))
    bad("string_too_long", binary_vtk(more=b"FIELD FieldData 1\ns 1 1 string\n\x3f\xff\xff\xff\xff\xff\xff\xffabc"), "within strings")
    bad("strings_too_many", binary_vtk(more=b"FIELD FieldData 1\ns 1 2147483647 string\n\xc1a"))
    b = binary_vtk()
    for size in (90, 100, 150, 200, len(b) - 20):
        bad("binary_cut_%d" % size, b[:size])
    bad("binary_nan", b.replace(struct.pack(">d", 1.0), struct.pack(">d", float("nan")), 1), "not finite")
    case("vtk_open.vtk", vtk(faces=F4[1:]), NO_SPHERE, "boundary edge")
    case("vtk_no_faces.vtk", vtk(polygons="POLYGONS 0 0\n"), NO_SPHERE, "no faces")


# --- VTK XML -----------------------------------------------------------------------------------

def array(kind, name, data, form="ascii", more=""):
    return '<DataArray type="%s" Name="%s" format="%s"%s>%s</DataArray>' % (kind, name, form, more, data)


def vtp(points=None, connectivity=None, offsets=None, attributes="", data="", tail="", counts='NumberOfPoints="4" NumberOfPolys="4"'):
    points = points or array("Float32", "Points", words(POINTS), more=' NumberOfComponents="3"')
    connectivity = connectivity or array("Int32", "connectivity", words(INDICES))
    offsets = offsets or array("Int32", "offsets", "3 6 9 12")
    return ('<?xml version="1.0"?>\n<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian"%s>\n<PolyData>\n<Piece %s>\n'
            "%s<Points>%s</Points>\n<Polys>%s%s</Polys>\n</Piece>\n</PolyData>\n%s</VTKFile>\n" %
            (attributes, counts, data, points, connectivity, offsets, tail))


def block(data, size=None):
    return struct.pack("<I", len(data) if size is None else size) + data


def squeezed(data, blocks=1, size=None, last=None, packed_size=None):
    packed = zlib.compress(data)
    size = len(data) if size is None else size
    header = struct.pack("<4I", blocks, size, size if last is None else last, len(packed) if packed_size is None else packed_size)
    return (base64.b64encode(header) + base64.b64encode(packed)).decode()


def make_vtp():
    t = vtp()
    raw = struct.pack("<12f", *POINTS)
    three = ' NumberOfComponents="3"'
    coordinates = lambda data, form="binary", more="": array("Float32", "Points", data, form, three + more)
    ok = lambda name, data: case("vtp_ok_%s.vtp" % name, data, OK)
    bad = lambda name, data, message="": case("vtp_%s.vtp" % name, data, UNREADABLE, message)
    plain = lambda data: base64.b64encode(data).decode()
    zipped = ' compressor="vtkZLibDataCompressor"'
    appended = lambda data, encoding="raw": '<AppendedData encoding="%s">_' % encoding + data + "</AppendedData>"
    ok("ascii", t)
    ok("binary", vtp(coordinates(plain(block(raw)))))
    ok("compressed", vtp(coordinates(squeezed(raw)), attributes=zipped))
    ok("appended_raw", vtp(coordinates("", "appended", ' offset="3"'), tail=appended("xyz" + block(raw).decode("latin-1") + "\0\1<&>")))
    ok("appended_base64", vtp(coordinates("", "appended", ' offset="0"'), tail=appended(plain(block(raw)), "base64")))
    ok("big_endian", vtp(coordinates(plain(struct.pack(">I12f", 48, *POINTS)))).replace("Little", "Big"))
    ok("empty_sections", t.replace("<Points>", "<PointData/><CellData></CellData><Verts></Verts><Points>"))
    ok("values_that_are_not_finite", vtp(data="<PointData>%s</PointData>" % array("Float32", "a", "1 nan 2 inf")))
    bad("image_data", t.replace("PolyData", "ImageData"), "'ImageData'")
    bad("other_compressor", vtp(attributes=' compressor="vtkLZMADataCompressor"'), "vtkLZMADataCompressor")
    bad("other_header", vtp(attributes=' header_type="UInt16"'), "header_type")
    bad("no_piece", t[:t.index("<Piece")] + t[t.index("</PolyData>"):], "no <Piece>")
    bad("cut_in_data", t[:t.index("</Points>")], "malformed XML")
    bad("cut_in_tag", t[:30])
    bad("entity", t.replace("?>\n", '?>\n<!DOCTYPE VTKFile [<!ENTITY a "b">]>\n', 1), "declares an entity")
    bad("deep", t.replace("<Points>", "<a>" * 2000 + "</a>" * 2000 + "<Points>"), "nested deeper")
    bad("array_in_array", t.replace('"connectivity" format="ascii">', '"connectivity" format="ascii"><DataArray/>'), "array within an array")
    bad("data_outside_a_piece", t.replace("<Piece", "<PointData>%s</PointData><Piece" % array("Int8", "a", "1")), "outside of a <Piece>")
    bad("points_twice", t.replace("</Points>", coordinates(words(POINTS), "ascii") + "</Points>"), "second one")
    for count in (-1, 0, 3, 5, 2**28, 2**31, 2**63):
        tag = str(count).replace("-", "minus")
        bad("points_" + tag, vtp(counts='NumberOfPoints="%d" NumberOfPolys="4"' % count))
        bad("binary_points_" + tag, vtp(coordinates(plain(block(raw))), counts='NumberOfPoints="%d" NumberOfPolys="4"' % count))
        if count != 0:
            bad("polys_" + tag, vtp(counts='NumberOfPoints="4" NumberOfPolys="%d"' % count))
    bad("components_2", t.replace('NumberOfComponents="3"', 'NumberOfComponents="2"'), "three coordinates")
    bad("components_huge", t.replace('NumberOfComponents="3"', 'NumberOfComponents="2147483647"'), "components")
    bad("type_unknown", t.replace("Float32", "Float128"), "unknown type 'Float128'")
    bad("format_unknown", t.replace('format="ascii"', 'format="morse"', 1), "unknown format 'morse'")
    for size in (0, 4, 47, 49, 2**31, 2**32 - 1):
        bad("binary_size_%d" % size, vtp(coordinates(plain(block(raw, size)))))
        bad("block_size_%d" % size, vtp(coordinates(squeezed(raw, size=size, last=0)), attributes=zipped))
        bad("packed_size_%d" % size, vtp(coordinates(squeezed(raw, packed_size=size)), attributes=zipped))
    for blocks in (0, 2, 2**32 - 1):
        bad("blocks_%d" % blocks, vtp(coordinates(squeezed(raw, blocks=blocks)), attributes=zipped))
    bomb = bytes(16 << 20)
    bad("bomb", vtp(coordinates(squeezed(bomb)), attributes=zipped), "more numbers than the file can hold")
    bad("compressed_garbage", vtp(coordinates(plain(struct.pack("<4I", 1, 48, 0, 48)) + plain(raw)), attributes=zipped), "corrupt")
    bad("base64_garbage", vtp(coordinates("!" + plain(block(raw))[1:])), "no base64")
    bad("base64_cut", vtp(coordinates(plain(block(raw))[:-7])), "cut short")
    for offset in ("-1", "100", "18446744073709551615", "x", ""):
        bad("offset_" + (offset or "missing").replace("-", "minus"), vtp(coordinates("", "appended", ' offset="%s"' % offset), tail=appended(block(raw).decode("latin-1"))))
    bad("nothing_appended", vtp(coordinates("", "appended", ' offset="0"')))
    bad("index_beyond", vtp(connectivity=array("Int32", "connectivity", words(INDICES[:-1] + [4]))), "not one of the 4")
    bad("index_negative", vtp(connectivity=array("Int32", "connectivity", words(INDICES[:-1] + [-1]))), "not one of the 4")
    bad("index_twice", vtp(connectivity=array("Int32", "connectivity", words(INDICES[:-1] + [2]))), "names a vertex twice")
    bad("offsets_fall", vtp(offsets=array("Int32", "offsets", "3 9 6 12")), "does not fit")
    bad("offsets_beyond", vtp(offsets=array("Int32", "offsets", "3 6 9 13")), "does not fit")
    bad("offsets_missing", vtp(offsets=" "), "lacks connectivity or offsets")
    bad("number_nan", vtp(coordinates(words(POINTS[:-1] + ["nan"]), "ascii")), "not finite")
    bad("number_word", vtp(coordinates(words(POINTS[:-1] + ["x"]), "ascii")), "for a number")
    many = "".join(array("UInt8", "a%d" % i, "", "appended", ' offset="0" NumberOfComponents="256"') for i in range(200))
    bad("arrays_that_share_bytes_and_ask_for_too_much",
        vtp(data="<PointData>%s</PointData>" % many, attributes=zipped, tail=appended(squeezed(bytes(1024 * 1024)), "base64")))
    case("vtp_open.vtp", vtp(connectivity=array("Int32", "connectivity", words(INDICES[3:])), offsets=array("Int32", "offsets", "3 6 9"),
                             counts='NumberOfPoints="4" NumberOfPolys="3"'), NO_SPHERE, "boundary edge")


# --- MZ3 ---------------------------------------------------------------------------------------

def mz3(attributes=3, faces=4, vertices=4, skip=0, private=b"", tail=b"", indices=INDICES, points=POINTS):
    return (b"MZ" + struct.pack("<H3I", attributes, faces, vertices, skip) + private + struct.pack("<12i", *indices) +
            struct.pack("<12f", *points) + tail)


def make_mz3():
    b = mz3()
    ok = lambda name, data: case("mz3_ok_%s.mz3" % name, data, OK)
    bad = lambda name, data, message="": case("mz3_%s.mz3" % name, data, UNREADABLE, message)
    ok("plain", b)
    ok("packed", gzip.compress(b, mtime=0))
    ok("private_data", mz3(skip=5, private=b"hello"))
    ok("colours", mz3(7, tail=bytes(range(16))))
    ok("layers", mz3(11, tail=struct.pack("<8f", *range(8))))
    ok("doubles", mz3(19, tail=struct.pack("<4d", *range(4))))
    ok("layer_that_leaves_a_vertex_out", mz3(11, tail=struct.pack("<4f", 1, 2, float("nan"), 4)))
    ok("data_after_the_end", b + b"more")
    bad("magic_only", b"MZ")
    bad("program_of_windows", b"MZ\x90\0\3\0\0\0\4\0\0\0\xff\xff\0\0" + bytes(100), "attributes 144")
    bad("values_only", b"MZ" + struct.pack("<H3I", 8, 0, 4, 0) + bytes(16), "no mesh")
    bad("no_attributes", mz3(0), "attributes 0")
    bad("both_kinds_of_layers", mz3(27, tail=bytes(48)), "32 bits and of 64")
    bad("half_a_layer", mz3(11, tail=bytes(15)), "no whole layers")
    bad("no_layer", mz3(11), "no whole layers")
    for count in (5, 2**28, 2**31, 2**32 - 1):
        bad("faces_%d" % count, mz3(faces=count))
        bad("vertices_%d" % count, mz3(vertices=count))
        bad("skip_%d" % count, mz3(skip=count))
    for size in (8, 15, 16, 40, len(b) - 1):
        bad("cut_%d" % size, b[:size])
    bad("packed_cut", gzip.compress(b, mtime=0)[:40], "gzip data is cut short")
    bad("index_beyond", mz3(indices=INDICES[:-1] + [4]), "names vertex 4 of 4")
    bad("index_negative", mz3(indices=INDICES[:-1] + [-1]), "names vertex -1 of 4")
    bad("index_twice", mz3(indices=INDICES[:-1] + [2]), "names a vertex twice")
    bad("nan", mz3(points=POINTS[:-1] + [float("nan")]), "vertex 3 is not finite")
    case("mz3_no_faces.mz3", mz3(faces=0)[:16] + mz3()[64:], NO_SPHERE, "no faces")


# --- FreeSurfer --------------------------------------------------------------------------------

GEOMETRY = b"".join(b"%s = 1 0 0\n" % k for k in (b"valid", b"filename", b"volume", b"voxelsize", b"xras", b"yras", b"zras", b"cras"))


def surface(vertices=4, faces=4, created=b"created by hand\n\n", footer=b"", indices=INDICES, points=POINTS, magic=b"\xff\xff\xfe"):
    return (magic + created + struct.pack(">2i", vertices, faces) + struct.pack(">12f", *points) + struct.pack(">12i", *indices) + footer)


def make_freesurfer():
    b = surface()
    ok = lambda name, data: case("freesurfer_ok_%s.white" % name, data, OK)
    bad = lambda name, data, message="": case("freesurfer_%s.white" % name, data, UNREADABLE, message)
    ok("plain", b)
    ok("packed", gzip.compress(b, mtime=0))
    ok("one_line_end", surface(created=b"created by hand\n"))
    ok("geometry", surface(footer=struct.pack(">3i", 2, 0, 20) + GEOMETRY))
    ok("geometry_alone", surface(footer=struct.pack(">i", 20) + GEOMETRY))
    ok("geometry_cut", surface(footer=struct.pack(">3i", 2, 0, 20) + GEOMETRY[:30]))
    ok("geometry_of_no_lines", surface(footer=struct.pack(">3i", 2, 0, 20) + b"\xff" * 500))
    ok("commands", surface(footer=struct.pack(">3i", 2, 1, 20) + GEOMETRY + struct.pack(">iq", 3, 8) + b"mris_foo"))
    ok("tag_cut", surface(footer=b"\0\0"))
    bad("values", surface(magic=b"\xff\xff\xff"), "file of values")
    bad("quadrangles", surface(magic=b"\xff\xff\xfd"), "quadrangle surface")
    bad("magic_only", b"\xff\xff\xfe", "ends within")
    bad("line_without_end", b"\xff\xff\xfe" + b"a" * 500, "ends within")
    for count in (-1, 5, 2**28, 2**31 - 1):
        tag = str(count).replace("-", "minus")
        bad("vertices_" + tag, surface(vertices=count))
        bad("faces_" + tag, surface(faces=count))
    for size in (10, 20, 27, 60, len(b) - 1):
        bad("cut_%d" % size, b[:size], "ends within")
    bad("index_beyond", surface(indices=INDICES[:-1] + [4]), "names vertex 4 of 4")
    bad("index_negative", surface(indices=INDICES[:-1] + [-1]), "names vertex -1 of 4")
    bad("index_twice", surface(indices=INDICES[:-1] + [2]), "names a vertex twice")
    bad("nan", surface(points=POINTS[:-1] + [float("nan")]), "vertex 3 is not finite")
    case("freesurfer_no_faces.white", surface(faces=0)[:-48], NO_SPHERE, "no faces")


def make_all():
    make_vtk()
    make_vtp()
    make_mz3()
    make_freesurfer()
