#!/usr/bin/env python3
"""Makes tests/hostile/files and expected.tsv: small files that are wrong in one way each, or odd and
right all the same. A line of the table: file, exit code of `map` and `info`, a part of the message.

    tests/hostile/make_files.py        # after a change here; both results are committed
"""
import gzip
import shutil
import struct

import other_formats
import print_formats
import scene_formats
import science_formats
import shape_models
import value_files
from corpus import *

# --- OBJ ---------------------------------------------------------------------------------------

def make_obj():
    t = obj(P4, F4)
    ok = lambda name, text: case("obj_ok_%s.obj" % name, text, OK)
    bad = lambda name, text, message: case("obj_%s.obj" % name, text, UNREADABLE, message)
    ok("plain", t)
    ok("crlf", t.replace("\n", "\r\n"))
    ok("cr", t.replace("\n", "\r"))
    ok("byte_order_mark", "\xef\xbb\xbf" + t)
    ok("no_last_newline", t[:-1])
    ok("signed_by_dollars", "$ exported by hand\n\n$$$\n" + t + "$\n")
    ok("blank_lines_tabs", t.replace(" ", "\t").replace("\n", "\n\n \n"))
    ok("comments", "# a\n" + t.replace("\n", " # b\n"))
    ok("relative", obj(P4, []) + "f -4 -2 -3\nf -4 -3 -1\nf -4 -1 -2\nf -3 -2 -1\n")
    ok("forward_references", "".join(sorted(t.splitlines(True))))
    ok("plus_signs", t.replace("v 1 1 1", "v +1 +1 +1"))
    ok("exponents", t.replace("v 1 1 1", "v 1e0 10E-1 .1e+1"))
    ok("underflow_is_zero", t.replace("v 1 1 1", "v 1 1 1e-999"))
    ok("leading_zeros", t.replace("f 1 3 2", "f 001 03 2"))
    ok("material_library_is_not_opened", "mtllib ../../../../etc/passwd\nusemtl /etc/shadow\n" + t)
    ok("long_material_name", "usemtl " + "m" * 5000 + "\n" + t)
    ok("control_characters_in_comment", "# \x01\x1b[31m\x7f\n" + t)
    ok("high_bytes_in_names", "o \xff\xfe\xc3\x28\n" + t)
    ok("continued_line", t.replace("f 1 3 2", "f 1 \\\n3 \\\n2"))
    ok("continued_at_the_end", t + "g a \\")
    ok("comment_like_vtk", "# vtk DataFile Version 3.0\n" + t)  # found by fuzzing
    ok("comment_like_a_material", "# sphparam material \x01`\n# o\n" + t)  # found by fuzzing
    ok("weights", t.replace("v 1 1 1", "v 1 1 1 0.5"))
    ok("colours", t.replace("v 1 1 1", "v 1 1 1 0.5 0.5 0.5"))
    ok("lines_and_points", t + "l 1 2\np 1\n")
    ok("normals_nobody_uses", t + "vn 0 0 1\n" * 50)
    ok("texture_in_three_dimensions", t + "vt 0 0 0\n")
    ok("unused_vertices", "v 9 9 9\n" * 20 + obj([], []) + "".join("v %s %s %s\n" % p for p in P4) +
       "".join("f " + " ".join(str(v + 21) for v in f) + "\n" for f in F4))
    ok("unwelded", "".join("v %s %s %s\n" % P4[v] for f in F4 for v in f) +
       "".join("f %d %d %d\n" % (3 * i + 1, 3 * i + 2, 3 * i + 3) for i in range(4)))
    ok("huge", obj([tuple("%de300" % c for c in p) for p in P4], F4))
    ok("tiny", obj([tuple("%de-300" % c for c in p) for p in P4], F4))
    ok("denormal", obj([tuple("%de-320" % c for c in p) for p in P4], F4))
    ok("mixed_sizes", obj([("1e300", 1, 1), (-1, "-1e-300", 1), (-1, 1, "-1e-320"), (1, -1, -1)], F4))
    ok("far_away", obj([tuple("1000000000.00%d" % (c + 1) for c in p) for p in P4], F4))
    ok("flat", obj([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], F4))
    case("obj_all_in_one_point.obj", obj([(1, 2, 3)] * 4, F4), NO_SPHERE, "no area")
    ok("inside_out", obj(P4, [f[::-1] for f in F4]))
    ok("quads", obj(*open_cube()))

    bad("index_zero", changed(t, "f 1 3 2", "f 0 3 2"), ":5: vertex index 0: indices start at 1")
    bad("index_beyond", changed(t, "f 1 3 2", "f 1 3 5"), ":5: face names vertex 5 of 4")
    bad("index_far_beyond", changed(t, "f 1 3 2", "f 1 3 2147483647"), "vertex 2147483647 of 4")
    bad("index_over_int", changed(t, "f 1 3 2", "f 1 3 2147483649"), "2147483649 is out of range")
    bad("index_over_long", changed(t, "f 1 3 2", "f 1 3 99999999999999999999"), "expected an index")
    bad("index_wraps_to_one", changed(t, "f 1 3 2", "f 1 3 4294967298"), "out of range")
    bad("relative_before_first", changed(t, "f 1 3 2", "f -5 3 2"), "relative vertex index -5 points before")
    bad("relative_far_before", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -100 -2 -1\n", ":4: relative vertex index -100")
    bad("relative_least_long", changed(t, "f 1 3 2", "f -9223372036854775808 3 2"), "points before")
    bad("relative_before_vertices", "f -1 -2 -3\n" + t, ":1: relative vertex index -1 points before the first of 0")
    bad("repeated_index", changed(t, "f 1 3 2", "f 1 3 1"), ":5: face names a vertex twice")
    bad("repeated_by_sign", changed(t, "f 1 3 2", "f 1 3 -4"), "names a vertex twice")
    bad("two_corners", changed(t, "f 1 3 2", "f 1 3"), "fewer than 3 corners")
    bad("no_corners", changed(t, "f 1 3 2", "f"), "fewer than 3 corners")
    bad("fraction_index", changed(t, "f 1 3 2", "f 1.0 3 2"), "expected an index, found '1.0'")
    bad("word_index", changed(t, "f 1 3 2", "f a 3 2"), "expected an index, found 'a'")
    bad("four_indices_a_corner", changed(t, "f 1 3 2", "f 1/1/1/1 3 2"), "more than three indices")
    bad("texture_beyond", changed(t, "f 1 3 2", "f 1/1 3 2"), "texture coordinate 1 of 0")
    bad("normal_beyond", changed(t, "f 1 3 2", "f 1//7 3 2"), "normal 7 of 0")
    bad("texture_zero", changed(t, "f 1 3 2", "f 1/0 3 2"), "texture coordinate index 0")
    bad("normal_before_first", "vn 0 0 1\n" + changed(t, "f 1 3 2", "f 1//-2 3 2"), "relative normal index -2")
    bad("slash_and_word", changed(t, "f 1 3 2", "f 1/x 3 2"), "expected an index")
    for i, word in enumerate(("nan", "-nan", "inf", "-INF", "infinity", "NaN(1)", "0x10", "0x1p3", "1e", "1e+", "--1", "+-1", "1..2",
                                 "1_000", "1q5", "$", "1e99999", "-1e309", "'1'", "1f")):
        bad("number_%d" % i, changed(t, "v 1 1 1", "v 1 1 " + word), ":1: expected a number")
    for i, word in enumerate(("-1.#IND", "1.#INF", "1.#QNAN0", "1.#SNAN")):
        bad("microsoft_%d" % i, changed(t, "v 1 1 1", "v 1 1 " + word), ":1: expected a number, found '%s'" % word)
    ok("exponents_of_fortran", t.replace("v 1 1 1", "v 1D0 10d-1 .1D+1"))
    ok("comment_at_a_number", changed(t, "v 1 1 1", "v 1 1 1#INFO"))
    bad("decimal_comma", changed(t, "v 1 1 1", "v 1,0 1,0 1,0"), "decimal point")
    bad("comma_separated", changed(t, "v 1 1 1", "v 1,1,1"), "decimal point")
    bad("two_coordinates", changed(t, "v 1 1 1", "v 1 1"), "found the end of the line")
    bad("no_coordinates", changed(t, "v 1 1 1", "v"), "found the end of the line")
    bad("five_numbers", changed(t, "v 1 1 1", "v 1 1 1 1 1"), "5 numbers")
    bad("eight_numbers", changed(t, "v 1 1 1", "v 1 1 1 1 1 1 1 1"), "unexpected '1'")
    bad("word_after_vertex", changed(t, "v 1 1 1", "v 1 1 1 a"), "expected a number, found 'a'")
    bad("normal_of_two", "vn 0 1\n" + t, ":1: expected a number")
    bad("normal_of_four", "vn 0 1 0 1\n" + t, "unexpected '1'")
    bad("texture_of_none", "vt\n" + t, ":1: expected a number")
    bad("texture_of_four", "vt 0 0 0 0\n" + t, "unexpected '0'")
    bad("nul", changed(t, "v 1 1 1", "v 1 1 1\0"), ":1: NUL byte")
    bad("nul_in_comment", "# a\n# \0\n" + t, ":2: NUL byte")
    bad("nul_at_end", t + "\0", ":9: NUL byte")
    ok("unknown_statement", t + "quux 1 2\n")
    ok("unknown_statements", "quux\n" * 500 + t + "\xff\xfe\x01\n" * 500)
    bad("unknown_statement_and_no_face", "v 1 1 1\nquux 1 2\nface 1 2 3\n", ":2: unknown statement 'quux'")
    bad("upper_case", t.replace("v ", "V "), "unknown statement 'V'")
    bad("binary_noise", "v 1 1 1\n" + "".join(chr(i) for i in range(1, 256)), "unknown statement")
    bad("html", "<html><body>404</body></html>\n", "unknown statement")
    bad("empty", "", "the file is empty")
    bad("byte_order_mark_only", "\xef\xbb\xbf", "the file is empty")
    bad("utf16", ("\xff\xfe" + "".join(c + "\0" for c in t)), "NUL byte")
    bad("continued_into_nothing", changed(t, "f 1 3 2", "f 1 \\\n\n3 2"), "fewer than 3 corners")
    ok("first_line_ends_in_cr", changed(t, "\n", "\r"))
    bad("lone_cr_in_a_face", changed(t, "f 1 3 2\n", "f 1 3 2\r"), ":5: expected an index, found 'f'")
    bad("same_line", t.replace("\n", " "), "found 'v'")
    bad("terminal_escape_in_word", "\x1b]0;owned\x07 1\n", "unknown statement '?]0;owned?'")
    ok("terminal_escape_in_unknown_word", t + "\x1b]0;owned\x07 1\n")
    case("obj_blanks.obj", " \n\t\n", NO_SPHERE, "no faces")
    case("obj_points.obj", obj(P4, []), NO_SPHERE, "no faces")
    case("obj_comment.obj", "# nothing\n", NO_SPHERE, "no faces")
    case("obj_without_vertices.obj", "g a\n", NO_SPHERE, "no faces")


# --- OFF ---------------------------------------------------------------------------------------

def make_off():
    t = off(P4, F4)
    ok = lambda name, text: case("off_ok_%s.off" % name, text, OK)
    bad = lambda name, text, message: case("off_%s.off" % name, text, UNREADABLE, message)
    ok("plain", t)
    ok("crlf", t.replace("\n", "\r\n"))
    ok("cr", t.replace("\n", "\r"))
    ok("byte_order_mark", "\xef\xbb\xbf" + t)
    ok("no_last_newline", t[:-1])
    ok("counts_on_the_keyword_line", changed(t, "OFF\n", "OFF "))
    ok("no_edge_count", changed(t, "4 4 0", "4 4"))
    ok("wrong_edge_count", changed(t, "4 4 0", "4 4 9999999"))
    ok("comments", "# a\n" + t.replace("\n", " # b\n"))
    ok("face_colours", t.replace("3 0 2 1", "3 0 2 1 255 0 0"))
    ok("face_colour_index", t.replace("3 0 2 1", "3 0 2 1 7"))
    ok("trailing_face", t + "3 0 1 2\n")
    ok("trailing_words", t + "that is all\n")
    ok("normals", "N" + t.replace("1 1 1\n", "1 1 1 0 0 1\n", 1).replace("-1 -1 1\n", "-1 -1 1 0 0 1\n")
       .replace("-1 1 -1\n", "-1 1 -1 0 0 1\n").replace("\n1 -1 -1\n", "\n1 -1 -1 0 0 1\n"))
    ok("keyword_promises_more", "STCN" + t)
    ok("unexplained_numbers", "\n".join(l + " 5 6" if i in (2, 3, 4, 5) else l for i, l in enumerate(t.split("\n"))))
    ok("huge", off([tuple("%de300" % c for c in p) for p in P4], F4))
    ok("quads", off(*open_cube()))
    bad("wrong_keyword", changed(t, "OFF", "OFG"), "found 'OFG'")
    bad("lower_case", changed(t, "OFF", "off"), "expected the keyword OFF")
    bad("keyword_glued", changed(t, "OFF\n", "OFFSET\n"), "expected the keyword OFF")
    bad("four_dimensions", "4" + t, "4OFF files (not three-dimensional) are not supported")
    bad("any_dimension", "n" + t, "nOFF files (not three-dimensional) are not supported")
    bad("all_prefixes", "STCN4n" + t, "not three-dimensional")
    bad("binary", "OFF BINARY\n\0\0\0\4", "binary OFF files are not supported")
    bad("keyword_only", "OFF", "ends before the counts")
    bad("keyword_and_comment", "OFF # 4 4 0", "ends before the counts")
    bad("one_count", "OFF\n4\n", "found the end of the line")
    bad("negative_vertices", changed(t, "4 4 0", "-4 4 0"), ":2: negative number of vertices")
    bad("negative_faces", changed(t, "4 4 0", "4 -4 0"), "negative number of faces")
    bad("negative_edges", changed(t, "4 4 0", "4 4 -1"), "negative edge count")
    bad("fraction_count", changed(t, "4 4 0", "4.0 4 0"), "expected a whole number")
    bad("word_count", changed(t, "4 4 0", "four 4 0"), "expected a whole number")
    bad("hex_count", changed(t, "4 4 0", "0x4 4 0"), "expected a whole number")
    bad("count_over_long", changed(t, "4 4 0", "99999999999999999999 4 0"), "expected a whole number")
    bad("fourth_count", changed(t, "4 4 0", "4 4 0 0"), "unexpected '0'")
    for count in (5000, 268435456, 268435457, 2147483647, 4294967300, 9223372036854775807):
        limit = "over the limit" if count > 268435456 else "do not fit"
        bad("vertices_%d" % count, changed(t, "4 4 0", "%d 4 0" % count), limit)
        bad("faces_%d" % count, changed(t, "4 4 0", "4 %d 0" % count), limit)
    bad("too_many_vertices", changed(t, "4 4 0", "5 4 0"), "unexpected '1'")
    bad("too_few_vertices", changed(t, "4 4 0", "3 4 0"), "fewer than 3 corners")
    bad("too_many_faces", changed(t, "4 4 0", "4 5 0"), "do not fit")
    bad("cut_in_vertices", t[:t.index("-1 1 -1")], "do not fit")
    bad("cut_in_faces", t[:t.index("3 0 3 2")], "do not fit")
    bad("cut_in_face", t[:-3], "found the end of the line")
    bad("index_beyond", changed(t, "3 0 2 1", "3 0 2 4"), ":7: face names vertex 4 of 4 (counted from 0)")
    bad("index_negative", changed(t, "3 0 2 1", "3 0 2 -1"), "face names vertex -1 of 4")
    bad("index_over_int", changed(t, "3 0 2 1", "3 0 2 4294967297"), "vertex 4294967297 of 4")
    bad("index_fraction", changed(t, "3 0 2 1", "3 0 2 1.5"), "expected a whole number")
    bad("index_twice", changed(t, "3 0 2 1", "3 0 2 0"), "names a vertex twice")
    bad("degree_zero", changed(t, "3 0 2 1", "0"), "fewer than 3 corners")
    bad("degree_two", changed(t, "3 0 2 1", "2 0 2 1"), "fewer than 3 corners")
    bad("degree_negative", changed(t, "3 0 2 1", "-3 0 2 1"), "fewer than 3 corners")
    bad("degree_huge", changed(t, "3 0 2 1", "2147483647 0 2 1"), "more corners than the limit")
    bad("degree_65537", changed(t, "3 0 2 1", "65537 0 2 1"), "more corners than the limit of 65536")
    bad("degree_65536", changed(t, "3 0 2 1", "65536 0 2 1"), "found the end of the line")
    bad("degree_fraction", changed(t, "3 0 2 1", "3.0 0 2 1"), "expected a whole number")
    bad("degree_more", changed(t, "3 0 2 1", "4 0 2 1"), "found the end of the line")
    for word in ("nan", "inf", "0x1", "1e400", "1,5", "x"):
        bad("number_%s" % word.replace(",", "_"), changed(t, "1 1 1\n", "1 1 %s\n" % word), ":3: expected a number")
    bad("microsoft", changed(t, "1 1 1\n", "1 1 -1.#IND\n"), ":3: expected a number, found '-1.#IND'")
    bad("two_coordinates", changed(t, "-1 -1 1\n", "-1 -1\n"), ":4: expected a number")
    bad("extra_coordinate", changed(t, "-1 -1 1\n", "-1 -1 1 7\n"), ":4: unexpected '7'")
    bad("keyword_explains_not", "N" + changed(t, "1 1 1\n", "1 1 1 5\n"), "which NOFF does not explain")
    bad("word_after_face", changed(t, "3 0 2 1", "3 0 2 1 red"), "expected a number, found 'red'")
    bad("nul", changed(t, "-1 -1 1\n", "-1 -1 \0001\n"), "NUL byte")
    bad("records_on_one_line", t.replace("\n", " "), "unexpected '1'")
    bad("empty", "", "the file is empty")
    case("off_nothing.off", "OFF\n0 0 0\n", NO_SPHERE, "no faces")
    case("off_no_faces.off", off(P4, []), NO_SPHERE, "no faces")


# --- PLY, text ---------------------------------------------------------------------------------

def make_ply():
    t = ply(P4, F4)
    ok = lambda name, text: case("ply_ok_%s.ply" % name, text, OK)
    bad = lambda name, text, message: case("ply_%s.ply" % name, text, UNREADABLE, message)
    ok("plain", t)
    ok("crlf", t.replace("\n", "\r\n"))
    ok("cr", t.replace("\n", "\r"))
    ok("byte_order_mark", "\xef\xbb\xbf" + t)
    ok("no_last_newline", t[:-1])
    ok("vertex_index", t.replace("vertex_indices", "vertex_index"))
    ok("modern_types", t.replace("float", "float64").replace("uchar int", "uint8 int32"))
    ok("comments", t.replace("element", "comment \x1b[31m\nobj_info x\nelement"))
    ok("trailing_data", t + "3 0 1 2\n")
    fillers = lambda kind, marks: "".join(
        line + (" " + marks.pop(0) if line.startswith("3 ") else "") + "\n"
        for line in t.replace("end_header", "property %s filler\nend_header" % kind).splitlines())
    ok("fillers_but_one", fillers("uchar", ["1", "1", "0", "1"]))
    ok("fillers_alone", fillers("uchar", ["1", "1", "1", "1"]))
    ok("values_that_are_not_finite", fillers("float", ["nan", "1", "-inf", "1.#QNAN0"]))
    ok("fillers_of_odd_values", fillers("float", ["1", "0.5", "-1", "1e30"]))
    ok("empty_element", t.replace("end_header", "element edge 0\nproperty int a\nend_header"))
    ok("empty_element_without_properties", t.replace("end_header", "element edge 0\nend_header"))
    ok("unknown_element", t.replace("end_header", "element edge 1\nproperty int a\nend_header") + "7\n")
    ok("unknown_list", t.replace("end_header", "element tag 1\nproperty list int int a\nend_header") + "2 7 8\n")
    ok("faces_first", "ply\nformat ascii 1.0\nelement face 4\nproperty list uchar int vertex_indices\n"
       "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n" +
       "".join("3 %d %d %d\n" % f for f in F4) + "".join("%d %d %d\n" % p for p in P4))
    ok("many_properties", t.replace("element face", "".join("property uchar p%d\n" % i for i in range(200)) + "element face")
       .replace("1 1 1\n", "1 1 1" + " 7" * 200 + "\n").replace("-1 -1 1\n", "-1 -1 1" + " 7" * 200 + "\n")
       .replace("-1 1 -1\n", "-1 1 -1" + " 7" * 200 + "\n").replace("\n1 -1 -1\n", "\n1 -1 -1" + " 7" * 200 + "\n"))
    ok("property_names_like_paths", t.replace("element face", "property float ../../x\nelement face")
       .replace("1 1 1\n", "1 1 1 0\n").replace("-1 -1 1\n", "-1 -1 1 0\n").replace("-1 1 -1\n", "-1 1 -1 0\n")
       .replace("\n1 -1 -1\n", "\n1 -1 -1 0\n"))
    bad("magic_only", "ply", "the file ends within the header")
    bad("magic_and_newline", "ply\n", "the file ends within the header")
    bad("magic_upper_case", changed(t, "ply", "PLY"), "expected the magic word 'ply'")
    bad("magic_glued", changed(t, "ply\n", "plyx\n"), "expected the magic word 'ply'")
    bad("magic_and_word", changed(t, "ply\n", "ply x\n"), "expected the magic word 'ply'")
    bad("no_format", changed(t, "format ascii 1.0\n", ""), "no format line")
    bad("two_formats", changed(t, "format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n"), ":3: second format")
    bad("unknown_format", changed(t, "ascii", "binary_middle_endian"), "unknown format 'binary_middle_endian'")
    bad("unknown_version", changed(t, "1.0", "1.1"), "version '1.1'")
    bad("unknown_statement", changed(t, "element", "elephant"), "unknown header statement 'elephant'")
    bad("no_end_header", changed(t, "end_header\n", ""), "unknown header statement '1'")
    bad("header_word_after_end", changed(t, "end_header", "end_header x"), "unexpected 'x'")
    bad("header_nul", changed(t, "float x", "float\0x"), "NUL byte in the header")
    bad("element_without_name", changed(t, "element vertex 4", "element"), "element without a name")
    bad("element_without_count", changed(t, "element vertex 4", "element vertex"), "expected a count")
    bad("property_without_name", changed(t, "property float x", "property float"), "property without a name")
    bad("property_without_type", changed(t, "property float x", "property"), "unknown type ''")
    bad("property_first", changed(t, "element vertex 4\n", ""), "before the first element")
    bad("property_and_word", changed(t, "float x", "float x x"), "unexpected 'x'")
    bad("two_vertex_elements", changed(t, "element face", "element vertex"), "second element 'vertex'")
    bad("no_vertex_element", changed(t, "element vertex", "element point"), "no element vertex")
    bad("no_face_list", changed(t, "vertex_indices", "indices"), "no list vertex_indices")
    bad("two_face_lists", changed(t, "end_header", "property list uchar int vertex_index\nend_header") + " " * 50,
        "two lists")
    bad("face_indices_no_list", changed(t, "list uchar int", "int"), "is no list")
    bad("float_list_count", changed(t, "list uchar", "list float"), "list count of a floating-point type")
    bad("float_indices", changed(t, "uchar int", "uchar float"), "vertex indices of a floating-point type")
    bad("unknown_type", changed(t, "float x", "half x"), "unknown type 'half'")
    bad("type_int64", changed(t, "uchar int", "uchar int64"), "unknown type 'int64'")
    bad("x_missing", changed(t, "float x", "float w"), "no property x")
    bad("z_missing", changed(t, "property float z\n", ""), "no property z")
    bad("y_twice", changed(t, "float z", "float y"), "second property 'y'")
    bad("x_list", changed(t, "float x", "list uchar float x"), "property x is a list")
    strips = changed(changed(t, "element face", "element tristrips"), "uchar int", "int int")
    lists = lambda text, count=1: changed(strips[:strips.index("end_header")], "tristrips 4", "tristrips %d" % count) + (
        "end_header\n" + "".join("%s %s %s\n" % p for p in P4) + text)
    ok("strips", strips)
    ok("strips_restarted", lists("15 0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3\n"))
    ok("strips_in_one", lists("6 1 2 0 3 1 2\n"))
    ok("strips_of_nothing_too", lists("15 0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3\n1 0\n0\n3 -1 -1 -1\n", 4))
    case("ply_strips_of_nothing.ply", lists("4 0 1 -1 2\n"), NO_SPHERE, "no faces")
    bad("strips_index_beyond", lists("4 0 2 1 4\n"), ":14: strip names vertex 4 of 4")
    bad("strips_index_negative", lists("4 0 2 1 -2\n"), "strip names vertex -2 of 4")
    bad("strips_length_negative", lists("-1 0 2 1\n"), "negative length")
    bad("strips_length_huge", lists("2147483647 0 2 1\n"), "expected a whole number")
    bad("strips_of_reals", changed(strips, "int int", "int float"), "floating-point type")
    bad("strips_without_list", changed(strips, "list int int vertex_indices", "int a"), "strips have no list")
    bad("strips_count_huge", changed(strips, "tristrips 4", "tristrips 99999999999"), "tristrips")
    bad("element_without_properties", changed(t, "end_header", "element a 5\nend_header"), "no properties")
    bad("65_elements", changed(t, "end_header", "".join("element e%d 0\n" % i for i in range(63)) + "end_header"),
        "more elements than the limit of 64")
    ok("64_elements", changed(t, "end_header", "".join("element e%d 0\n" % i for i in range(62)) + "end_header"))
    bad("257_properties", changed(t, "element face", "".join("property uchar p%d\n" % i for i in range(254)) +
                                  "element face"), "more properties than the limit of 256")
    for count in ("-1", "4.0", "0x4", "1e3", "four", "+4", "99999999999999999999"):
        bad("count_%s" % count.replace(".", "_").replace("+", "plus").replace("-", "minus"),
            changed(t, "vertex 4", "vertex " + count), ":3: expected a count")
    for count in (5000, 268435456, 268435457, 2147483648, 4294967300, 9223372036854775807):
        bad("vertices_%d" % count, changed(t, "vertex 4", "vertex %d" % count), "do not fit")
        bad("faces_%d" % count, changed(t, "face 4", "face %d" % count), "do not fit")
    bad("faces_5", changed(t, "face 4", "face 5"), "do not fit")
    bad("faces_a_byte_each", changed(t, "face 4", "face 12"), "do not fit")
    bad("vertices_3", changed(t, "vertex 4", "vertex 3"), "face names vertex -1 of 3")
    bad("cut_in_header", t[:100], "ends within the header")
    bad("cut_before_body", t[:t.index("end_header") + 11], "do not fit")
    bad("cut_in_vertices", t[:t.index("-1 1 -1")], "do not fit")
    bad("cut_in_last_face", t[:-3], "found the end of the line")
    bad("number_missing", changed(t, "-1 -1 1", "-1 -1"), ":11: expected a number")
    bad("number_too_many", changed(t, "-1 -1 1", "-1 -1 1 1"), ":11: unexpected '1'")
    for word in ("nan", "inf", "-inf", "1e39", "0x1", "1,0", "x", "1-1"):
        bad("number_%s" % "".join(c if c.isalnum() else "_" for c in word), changed(t, "-1 -1 1", "-1 -1 " + word),
            ":11: expected a number")
    bad("index_beyond", changed(t, "3 0 2 1", "3 0 2 4"), ":14: face names vertex 4 of 4")
    bad("index_negative", changed(t, "3 0 2 1", "3 0 2 -1"), "face names vertex -1")
    bad("index_beyond_type", changed(t, "3 0 2 1", "3 0 2 2147483648"), "2147483648 is no number of type int")
    bad("index_fraction", changed(t, "3 0 2 1", "3 0 2 1.0"), "expected a whole number")
    bad("index_twice", changed(t, "3 0 2 1", "3 0 2 2"), "names a vertex twice")
    bad("degree_two", changed(t, "3 0 2 1", "2 0 2"), "fewer than 3 corners")
    bad("degree_zero", changed(t, "3 0 2 1", "0"), "fewer than 3 corners")
    bad("degree_negative", changed(changed(t, "list uchar", "list char"), "3 0 2 1", "-3 0 2 1"), "negative length")
    bad("degree_beyond_type", changed(t, "3 0 2 1", "256 0 2 1"), "256 is no number of type uchar")
    bad("degree_huge", changed(changed(t, "list uchar", "list uint"), "3 0 2 1", "4294967295 0 2 1"),
        "more corners than the limit of 65536")
    bad("list_huge", changed(t, "end_header", "element tag 1\nproperty list uint int a\nend_header") +
        "4294967295 7 8\n", "found the end of the line")
    bad("body_nul", changed(t, "-1 -1 1", "-1 -1 1\0"), "NUL byte")
    bad("texture_of_wrong_length", changed(t, "end_header", "property list uchar float texcoord\nend_header")
        .replace("3 0 2 1", "3 0 2 1 5 0 0 0 0 0").replace("3 0 1 3", "3 0 1 3 0").replace("3 0 3 2", "3 0 3 2 0")
        .replace("3 1 2 3", "3 1 2 3 0"), "5 numbers of texture coordinates")
    ok("long_line", changed(t, "element vertex", "comment " + "x" * 30000 + "\nelement vertex"))
    case("ply_no_faces.ply", ply(P4, []), NO_SPHERE, "no faces")
    case("ply_no_face_element.ply", t[:t.index("element face")] + "end_header\n" + "0 0 0\n" * 4, NO_SPHERE, "no faces")
    case("ply_nothing.ply", ply([], []), NO_SPHERE, "no faces")


# --- PLY, binary -------------------------------------------------------------------------------

def make_binary_ply(order, name):
    b = binary_ply(P4, F4, order)
    body = b.index(b"end_header\n") + 11
    ok = lambda what, data: case("ply_%s_ok_%s.ply" % (name, what), data, OK)
    bad = lambda what, data, message: case("ply_%s_%s.ply" % (name, what), data, UNREADABLE, message)
    swap = lambda text, old, new: text.replace(old.encode(), new.encode(), 1)
    ok("plain", b)
    ok("crlf_header", b[:body].replace(b"\n", b"\r\n") + b[body:])
    ok("trailing_data", b + b"\0" * 100)
    ok("doubles", binary_ply(P4, F4, order, "double"))
    ok("shorts", binary_ply(P4, F4, order, "short", "short", "ushort"))
    ok("chars", binary_ply(P4, F4, order, "char", "uint", "uchar"))
    ok("quads", binary_ply(*open_cube(), order))
    ok("empty_texture_lists", binary_ply(P4, F4, order, extra="property list uchar float texcoord\n", tail=b"\0"))
    bad("cr_header", b[:body].replace(b"\n", b"\r") + b[body:], "in CR alone")
    bad("byte_swapped", swap(b, "little" if order == "<" else "big", "big" if order == "<" else "little"), "face names vertex 33554432 of 4")
    bad("as_text", swap(b, "binary_little_endian" if order == "<" else "binary_big_endian", "ascii"), "NUL byte in a text file")
    for size in (body, body + 1, body + 11, body + 12, body + 47, body + 48, body + 49, len(b) - 12, len(b) - 1):
        bad("cut_at_%d" % (size - body), b[:size], "do not fit")
    for count in (5, 5000, 268435456, 268435457, 2147483648, 9223372036854775807):
        bad("vertices_%d" % count, swap(b, "vertex 4", "vertex %d" % count), "do not fit")
        bad("faces_%d" % count, swap(b, "face 4", "face %d" % count), "do not fit")
    bad("faces_a_byte_each", swap(b, "face 4", "face 40"), "do not fit")
    number = lambda code, value: struct.pack(order + code, value)
    for what, value in (("nan", float("nan")), ("inf", float("inf")), ("minus_inf", -float("inf"))):
        bad(what, b[:body + 4] + number("f", value) + b[body + 8:], "number is not finite in vertex 0 of 4")
    d = binary_ply(P4, F4, order, "double")
    bad("nan_double", d[:-52 - 8] + number("d", float("nan")) + d[-52:], "not finite in vertex 3 of 4")
    face = body + 48
    bad("index_beyond", b[:face + 1] + number("i", 4) + b[face + 5:], "face names vertex 4 of 4")
    bad("index_negative", b[:face + 1] + number("i", -1) + b[face + 5:], "face names vertex -1 of 4")
    bad("index_least", b[:face + 1] + number("i", -2**31) + b[face + 5:], "vertex -2147483648 of 4")
    bad("index_twice", b[:face + 1] + number("i", 2) + b[face + 5:], "names a vertex twice")
    bad("index_unsigned", swap(b, "uchar int", "uchar uint")[:face + 2] + number("I", 2**32 - 1) + b[face + 5:],
        "face names vertex")
    bad("degree_zero", b[:face] + b"\0" + b[face + 1:], "fewer than 3 corners")
    bad("degree_two", b[:face] + b"\2" + b[face + 1:], "fewer than 3 corners")
    bad("degree_255", b[:face] + b"\xff" + b[face + 1:], "face names vertex")
    bad("degree_negative", swap(b, "list uchar", "list char")[:face - 1] + b"\xfd" + b[face + 1:], "negative length")
    bad("degree_huge", binary_ply(P4, [], order, count="uint").replace(b"face 0", b"face 1") + number("I", 2**32 - 1) +
        b"\0" * 40, "more corners than the limit of 65536")
    bad("degree_least", binary_ply(P4, [], order, count="int").replace(b"face 0", b"face 1") + number("i", -2**31) +
        b"\0" * 40, "negative length")
    bad("degree_65536", binary_ply(P4, [], order, count="int").replace(b"face 0", b"face 1") + number("i", 65536) +
        b"\0" * 40, "the file ends within face 0 of 1")
    tagged = lambda kind: swap(b, "end_header", "element tag 1\nproperty list %s double a\nend_header" % kind)
    bad("list_huge", tagged("uint") + number("I", 2**32 - 1), "the file ends within tag 0 of 1")
    bad("list_negative", tagged("int") + number("i", -1), "negative length of list 'a'")
    bad("list_overflows_size", tagged("int") + number("i", 2**29), "the file ends within tag 0 of 1")
    bad("texture_lists_huge", binary_ply(P4, F4[:1], order, extra="property list int double texcoord\n",
                                         tail=number("i", 2**31 - 1)), "is longer than any face's may be")
    bad("records_of_an_empty_list", swap(b, "end_header", "element tag 4000000000\nproperty list uchar int a\nend_header"),
        "do not fit")
    case("ply_%s_no_faces.ply" % name, binary_ply(P4, [], order), NO_SPHERE, "no faces")


# --- Meshes that are no spheres ----------------------------------------------------------------

def make_no_spheres():
    cube, quads = open_cube()
    tetra2 = (P4 + [(x + 9, y, z) for x, y, z in P4], F4 + shifted(F4, 4))
    pinched = (P4 + [(2 + x, 2 + y, 2 + z) for x, y, z in P4][1:], F4 + [(0, 5, 4), (0, 4, 6), (0, 6, 5), (4, 5, 6)])
    fin = (P4 + [(5, 5, 5)], F4 + [(0, 1, 4)])
    flipped = (P4, [F4[0][::-1]] + F4[1:])
    moebius = ([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1)],
               [(0, 1, 2), (1, 2, 3), (2, 3, 4), (3, 4, 0), (4, 0, 1)])
    projective = (P6, [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5), (0, 5, 1), (1, 2, 4), (2, 3, 5), (3, 4, 1),
                       (4, 5, 2), (5, 1, 3)])
    for name, (points, faces), message in (
            ("one_triangle", (P4[:3], [(0, 1, 2)]), "boundary edge"),
            ("two_triangles_back_to_back", (P4[:3], [(0, 1, 2), (0, 2, 1)]), "same three vertices"),
            ("open_box", (cube, quads[:5]), "boundary edge"),
            ("hole", (P6, F6[:-1]), "boundary edge"),
            ("two_spheres", tetra2, "component"),
            ("pinched_vertex", pinched, "separate fans of faces"),
            ("fin", fin, "three or more faces"),
            ("one_face_flipped", flipped, "run through the same way"),
            ("moebius_band", moebius, "boundary edge"),
            ("projective_plane", projective, "run through the same way"),
            ("torus", torus(), "genus"),
            ("torus_of_seven_vertices", ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1)],
                                         [f for i in range(7) for f in ((i, (i + 1) % 7, (i + 3) % 7),
                                                                        (i, (i + 3) % 7, (i + 2) % 7))]), "genus"),
            ("torus_in_one_point", ([(0, 0, 0)] * len(torus()[0]), torus()[1]), "genus"),
            ("duplicate_face", (P4, F4 + F4[:1]), "same three vertices"),
            ("duplicate_sphere", (P4, F4 + F4), "4 faces have the same three"),
            ("edge_of_four_faces", (P4 + [(3, 3, 3), (4, 3, 3)], F4 + [(0, 5, 1), (0, 1, 4), (0, 4, 5), (1, 5, 4)]), "three or more faces")):
        for kind, write in (("obj", obj), ("off", off), ("ply", ply)):
            case("shape_%s.%s" % (name, kind), write(points, faces), NO_SPHERE, message)
        case("shape_%s_binary.ply" % name, binary_ply([tuple(map(float, p)) for p in points], faces, "<", "double"),
             NO_SPHERE, message)


# --- Other formats -----------------------------------------------------------------------------

def make_foreign():
    for name, data, message in (
            ("a.gz", b"\x1f\x8b\x08" + bytes(40), "gzip data is corrupt"), ("a.zip", b"PK\x03\x04" + bytes(40), "ZIP"),
            ("a.xz", b"\xfd7zXZ\0", "xz"), ("a.bz2", b"BZh91AY", "bzip2"), ("a.mz3", b"MZ\x03\0", "ends within"),
            ("lh.white", b"\xff\xff\xfe" + bytes(40), "ends within"), ("a.fbx", b"Kaydara FBX Binary  \0", "FBX"),
            ("a.png", b"\x89PNG\r\n\x1a\n" + bytes(40), "PNG"), ("a.jpg", b"\xff\xd8\xff\xe0" + bytes(40), "JPEG"),
            ("a.vtu", b"<VTKFile type=\"UnstructuredGrid\"/>", "UnstructuredGrid"), ("a.txt", b"hello\n", "not recognised"),
            ("a.bds", b"DAS/DSK " + bytes(1016), "dskexp"), ("a.lbl", b"PDS_VERSION_ID = PDS3\n", "PDS label"),
            ("a.bin", bytes(range(256)), "not recognised"), ("zeros.bin", bytes(512), "not recognised"),
            ("ones.bin", b"\xff" * 512, "not recognised"),
            ("gzip_named.obj", b"\x1f\x8b\x08\0", "gzip data is cut short"),
            ("png_named.ply", b"\x89PNG\r\n", "PNG"), ("noise_named.ply", bytes(range(255, 0, -1)), "magic word 'ply'"),
            ("noise_named.off", bytes(range(255, 0, -1)), "expected the keyword OFF")):
        case("foreign_" + name, data, UNREADABLE, message)


def make_gzip():
    pack = lambda data: gzip.compress(data.encode() if isinstance(data, str) else data, mtime=0)
    t = obj(P4, F4)
    packed = pack(t)
    ok = lambda name, data: case("gzip_ok_" + name, data, OK)
    bad = lambda name, data, message: case("gzip_" + name, data, UNREADABLE, message)
    ok("plain.obj.gz", packed)
    ok("named_as_if_unpacked.obj", packed)
    ok("named_as_another.ply.gz", packed)
    ok("without_a_name", pack(ply(P4, F4)))
    ok("off.off.gz", pack(off(P4, F4)))
    ok("binary.ply.gz", pack(binary_ply([tuple(map(float, p)) for p in P4], F4)))
    ok("members.obj.gz", pack(t[:20]) + pack("") + pack(t[20:]))
    ok("zeros_after.obj.gz", packed + bytes(1000))
    ok("garbage_after.obj.gz", packed + b"garbage")
    ok("not_packed.obj.gz", t)
    for size in (2, 3, 9, 10, 11, len(packed) // 2, len(packed) - 8, len(packed) - 1):
        bad("cut_%d.obj.gz" % size, packed[:size], "gzip data is cut short")
    bad("second_member_cut.obj.gz", packed + packed[:15], "gzip data is cut short")
    for name, at in (("method", 2), ("flags", 3), ("checksum", -8), ("length", -4)):
        broken = bytearray(packed)
        broken[at] ^= 0xE0
        bad("%s.obj.gz" % name, bytes(broken), "gzip data is ")
    for kind, text in (("vtk", science_formats.vtk()), ("vtp", science_formats.vtp()), ("mz3", science_formats.mz3()),
                       ("white", science_formats.surface())):
        ok("format.%s.gz" % kind, pack(text))
        whole = pack(text)
        bad("cut.%s.gz" % kind, whole[:len(whole) * 2 // 3], "gzip data is cut short")
    bad("twice.obj.gz", pack(packed), "gzip-compressed data within gzip")
    bad("of_nothing.obj.gz", pack(""), "the file is empty")
    bad("of_a_picture.gz", pack(b"\x89PNG\r\n\x1a\n" + bytes(40)), "PNG")
    bad("of_words.gz", pack("hello\n"), "not recognised")
    bad("bomb_of_blanks.gz", pack(b" " * (24 << 20)), "not recognised")
    bad("bomb_of_zeros.obj.gz", pack(bytes(24 << 20)), "NUL byte")
    bad("bomb_of_vertices.obj.gz", pack(b"v 0 0 0\n" * (1 << 20) + b"f 1 2 3 4294967295\n"), "out of range")


def main():
    shutil.rmtree(FILES, ignore_errors=True)
    FILES.mkdir()
    make_obj()
    make_off()
    make_ply()
    make_binary_ply("<", "little")
    make_binary_ply(">", "big")
    make_no_spheres()
    make_foreign()
    make_gzip()
    other_formats.make_all()
    print_formats.make_all()
    science_formats.make_all()
    scene_formats.make_all()
    shape_models.make_all()
    value_files.make_all()
    with open(HERE / "expected.tsv", "w") as table:
        for row in sorted(TABLE):
            table.write("%s\t%d\t%s\n" % row)
    print(len(TABLE), "files,", sum(f.stat().st_size for f in FILES.iterdir()), "bytes")


if __name__ == "__main__":
    main()
