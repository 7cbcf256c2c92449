#!/usr/bin/env python3
"""Bakes maps of a body and opens them with GDAL: where they lie, in which coordinate system, what
their numbers mean; as PDS4, about the pole, and against the shape itself.

    check_maps.py SPHPARAM
"""

import json
import math
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
RADIUS = 255.0  # of the IAU's Vesta, in km
TEXELS = 1024


def ran(*words, given=""):
    """What a program prints."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, input=given)
    assert done.returncode == 0, f"{' '.join(map(str, words))}: {done.stderr}"
    return done.stdout


def radius_at(direction):
    x, y, z = direction
    return RADIUS * (1 + 0.08 * math.sin(4 * x) * math.cos(3 * y + 1) - 0.06 * z * z)


def direction_of(longitude, latitude):
    theta, phi = math.radians(longitude), math.radians(latitude)
    return math.cos(theta) * math.cos(phi), math.sin(theta) * math.cos(phi), math.sin(phi)


def unit(point):
    length = math.sqrt(sum(x * x for x in point))
    return tuple(x / length for x in point)


def write_body(path, level=6):
    """A star-shaped body in km, y to the east of x: an icosahedron divided `level` times."""
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t),
              (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(level):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(unit([p + q for p, q in zip(points[a], points[b])]))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    with open(path, "w") as out:
        for d in map(unit, points):
            r = radius_at(d)
            out.write("v {!r} {!r} {!r}\n".format(*(r * x for x in d)))
        for f in faces:
            out.write("f {} {} {}\n".format(*(i + 1 for i in f)))


def info_of(path, *options):
    return json.loads(ran("gdalinfo", "-json", *options, path))


def samples(path, places, band=1):
    """The raw numbers at places: longitudes and latitudes."""
    text = "".join(f"{longitude} {latitude}\n" for longitude, latitude in places)
    return [float(x) for x in ran("gdallocationinfo", "-valonly", "-geoloc", "-b", band, path, given=text).split()]


def check_table():
    """Our names, radii and codes are PROJ's, all of them."""
    source = HERE.parents[2] / "libsphparam/src/bake/georeference/iau_bodies.cpp"
    ours = {int(code): (name, float(radius)) for name, radius, code in
            re.findall(r'\{"([^"]+)", ([0-9.]+), (\d+)\}', source.read_text())}
    query = """select g.code, g.name, e.semi_major_axis from geodetic_crs g
        join geodetic_datum d on g.datum_auth_name = d.auth_name and g.datum_code = d.code
        join ellipsoid e on d.ellipsoid_auth_name = e.auth_name and d.ellipsoid_code = e.code
        where g.auth_name = 'IAU_2015' and g.name like '% (2015) - Sphere / Ocentric'"""
    with sqlite3.connect("file:/usr/share/proj/proj.db?mode=ro", uri=True) as database:
        theirs = {int(code): (name.split(" (2015)")[0], float(radius))
                  for code, name, radius in database.execute(query)}
    assert len(ours) > 90 and ours == theirs, set(ours.items()) ^ set(theirs.items())
    return f"{len(ours)} bodies of the IAU as PROJ has them"


def check_place(info, name, code, west=False):
    """Corner coordinates and the coordinate system."""
    edge = 180.0 if west else -180.0
    corners = info["cornerCoordinates"]
    assert corners["upperLeft"] == [edge, 90.0], corners
    assert corners["lowerRight"] == [-edge, -90.0], corners
    wkt = info["coordinateSystem"]["wkt"]
    assert wkt.startswith(f'GEOGCRS["{name}"'), wkt
    assert (f'ID["IAU",{code},2015]' in wkt) if code else ('ID["IAU"' not in wkt), wkt
    assert ("west" if west else "east") in wkt, wkt


def check_numbers(path, range_of_bake, unit):
    """Scale, offset and unit; what the integers stand for is what was baked."""
    band = info_of(path, "-mm")["bands"][0]
    low, high = range_of_bake
    assert band["unit"] == unit, band
    assert band["offset"] == low and math.isclose(band["scale"], (high - low) / 65535), band
    least, greatest = (band["offset"] + band["scale"] * band[key] for key in ("computedMin", "computedMax"))
    assert math.isclose(least, low, rel_tol=1e-6) and math.isclose(greatest, high, rel_tol=1e-6)
    return band


def check_values(folder, band):
    """Every number is that of the middle of its texel."""
    places = [(longitude, latitude) for longitude in range(-170, 180, 20) for latitude in range(-80, 81, 20)]
    radii = samples(folder / "radius.tif", places)
    longitudes, latitudes = (samples(folder / "lonlat.tif", places, band) for band in (1, 2))
    worst_radius = worst_place = 0.0
    for (longitude, latitude), raw, lon, lat in zip(places, radii, longitudes, latitudes, strict=True):
        x = (math.floor((longitude + 180) / 360 * TEXELS) + 0.5) / TEXELS * 360 - 180
        y = 90 - (math.floor((90 - latitude) / 360 * TEXELS) + 0.5) / TEXELS * 360
        off = abs(math.remainder(lon - x, 360)) * math.cos(math.radians(y))
        worst_radius = max(worst_radius, abs(band["offset"] + band["scale"] * raw - radius_at(direction_of(x, y))))
        worst_place = max(worst_place, off, abs(lat - y))
    # The shape is flat between vertices, 1.1 degrees apart: 1.3e-4 of the radius below the formula.
    assert worst_radius < 2e-4 * RADIUS, worst_radius
    assert worst_place < 0.001, worst_place
    return f"radius to {worst_radius / RADIUS:.1e} of it, places to {worst_place:.1e}°"


def check_pds4(folder):
    label = folder / "label.xml"
    ran("gdal_translate", "-q", "-of", "PDS4", "-co", "VAR_TARGET=4_Vesta", "-co", "VAR_TARGET_TYPE=Asteroid",
        "-co", "VAR_LOGICAL_IDENTIFIER=urn:nasa:pds:x:y:z", "-co", "VAR_TITLE=radius", folder / "radius.tif",
        label)
    text = label.read_text()
    for words in ("<cart:latitude_type>Planetocentric</cart:latitude_type>",
                  "<cart:longitude_direction>Positive East</cart:longitude_direction>",
                  '<cart:west_bounding_coordinate unit="deg">-180</cart:west_bounding_coordinate>',
                  "4_Vesta"):
        assert words in text, f"{words} is not in the label"
    axis = re.search(r'<cart:a_axis_radius unit="(\w+)">([0-9.]+)<', text)
    assert axis and float(axis[2]) * (1000 if axis[1] == "km" else 1) == 1000 * RADIUS, axis
    back = info_of(label)
    assert back["bands"][0]["scale"] == info_of(folder / "radius.tif")["bands"][0]["scale"]


def check_polar(folder):
    """All of a square about the north pole has values, and they are the body's."""
    polar, side = folder / "polar.tif", 150000
    ran("gdalwarp", "-q", "-r", "near", "-t_srs",
        "IAU_2015:200000430", "-te", -side, -side, side, side,
        "-ts", 200, 200, "-dstnodata", -9999, "-ot", "Float32", folder / "radius_float.tif", polar)
    info = info_of(polar, "-stats")
    valid = info["bands"][0]["metadata"][""]["STATISTICS_VALID_PERCENT"]
    assert float(valid) == 100, valid
    pole = float(ran("gdallocationinfo", "-valonly", polar, 100, 100))
    assert math.isclose(pole, radius_at((0, 0, 1)), rel_tol=1e-3), pole


def bake(program, folder, mapped, *options):
    report = folder / "bake.json"
    ran(program, "bake", mapped, "--size", TEXELS, "--json", report, *options)
    return json.loads(report.read_text())


def check_maps(program, folder):
    body = folder / "vesta.obj"
    write_body(body)
    radial = folder / "vesta.sph.ply"
    ran(program, "map", body, "-o", radial, "--method", "radial")
    of_vesta = ("--body", "Vesta", "--unit", "km")
    baked = bake(program, folder, radial, *of_vesta, "--map", "radius,slope", "-o", folder / "{map}.tif")
    bake(program, folder, radial, *of_vesta, "--depth", "float", "--map", "lonlat", "-o", folder / "lonlat.tif")
    bake(program, folder, radial, *of_vesta, "--depth", "float", "--map", "radius", "-o",
         folder / "radius_float.tif")
    bake(program, folder, radial, *of_vesta, "--map", "radius,normal-object", "-o", folder / "{map}.png")
    name, code = "Vesta (2015) - Sphere / Ocentric", 200000400
    for image in ("radius.tif", "slope.tif", "lonlat.tif", "radius_float.tif", "radius.png", "normal-object.png"):
        check_place(info_of(folder / image), name, code)
    band = check_numbers(folder / "radius.tif", baked["images"][0]["range"], "km")
    assert band["description"] == "radius"
    check_numbers(folder / "radius.png", baked["images"][0]["range"], "km")
    values = check_values(folder, band)
    check_pds4(folder)
    check_polar(folder)
    bake(program, folder, radial, *of_vesta, "--west", "--map", "lon", "-o", folder / "west.tif")
    check_place(info_of(folder / "west.tif"), name + ", positive west", None, west=True)
    there = info_of(folder / "west.tif")["bands"][0]
    west = there["offset"] + there["scale"] * samples(folder / "west.tif", [(60, 10)])[0]
    assert abs(west - 60) < 0.5, west
    return values


def check_honesty(program, folder):
    """A map that is not radial has a coordinate system of its own."""
    mapped = folder / "own.sph.ply"
    ran(program, "map", folder / "vesta.obj", "-o", mapped, "--quality", "draft")
    bake(program, folder, mapped, "--body", "Vesta", "--unit", "km", "--map", "radius", "-o", folder / "own.tif")
    check_place(info_of(folder / "own.tif"), "sphparam map of Vesta", None)


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    print("gdal: " + check_table())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print("gdal: maps of a body open in place; " + check_maps(program, folder))
        check_honesty(program, folder)
    print("gdal: PDS4, polar warp, west longitudes, a map's own coordinates: as they should be")


main()
