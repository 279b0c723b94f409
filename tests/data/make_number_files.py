#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes tests/data/numbers: the same points and readings in every binary format that is read, by
other programs' writers (numpy, scipy.io, h5py; X3P by zipfile and hashlib), and broken ones.

The points lie on a circle of radius 20 mm about (1, -2, 3) mm; the readings are those of a shaft of
radius 20 mm at Z = -10 mm whose centre stands 0.05 mm off the spindle axis. The formulas are
repeated in tests/unit/number_files_test.cpp. The same bytes each time.
"""
import hashlib
import io
import os
import struct
import zipfile

import h5py
import numpy as np
import scipy.io

folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "numbers")
os.makedirs(folder, exist_ok=True)
n = 24
turn = 2 * np.pi * np.arange(n) / n
points = np.stack([1 + 20 * np.cos(turn), -2 + 20 * np.sin(turn), 3 + 0 * turn], axis=1)
c_deg = 360.0 * np.arange(n) / n
x_mm = 20 + 0.05 * np.cos(turn)
z_mm = np.full(n, -10.0)


def put(name, data):
    with open(os.path.join(folder, name), "wb") as file:
        file.write(data)


def npy(array, **more):
    out = io.BytesIO()
    np.lib.format.write_array(out, np.asanyarray(array), **more)
    return out.getvalue()


def packed(members, method=zipfile.ZIP_DEFLATED):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", method) as archive:
        for name, data in members:
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), data, method)
    return out.getvalue()


# NumPy: C and Fortran order, big-endian, single precision, records, what is no table
put("points.npy", npy(points))
put("points_fortran.npy", npy(np.asfortranarray(points)))
put("points_big_endian.npy", npy(points.astype(">f8")))
put("points_um_int32.npy", npy(np.rint(points * 1000).astype("<i4")))
put("points_lying.npy", npy(points.T.copy()))
put("points_nan.npy", npy(np.where(np.arange(3 * n).reshape(n, 3) == 10, np.nan, points)))
records = np.zeros(n, dtype=[("x", "<f8"), ("y", "<f8"), ("z", "<f4")])
records["x"], records["y"], records["z"] = points.T
put("points_records.npy", npy(records))
put("complex.npy", npy(points + 1j))
put("cube.npy", npy(np.zeros((2, 3, 4))))
put("objects.npy", npy(np.array([None, 1], dtype=object), allow_pickle=True))
put("cut.npy", npy(points)[:-9])
header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (4000000000, 4000000000), }"
header += b" " * (117 - len(header)) + b"\n"
put("huge.npy", b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header)
put("stream.npz", packed([("X.npy", npy(x_mm)), ("C.npy", npy(c_deg)), ("Z.npy", npy(z_mm)),
                          ("rate.npy", npy(np.array([1000.0])))]))
put("cut.npz", packed([("X.npy", npy(x_mm)), ("C.npy", npy(c_deg))])[:-40])
changed = bytearray(packed([("X.npy", npy(x_mm))], zipfile.ZIP_STORED))
changed[200] ^= 1  # a reading; the archive's CRC tells
put("changed.npz", bytes(changed))
# An archive that says a member unpacks to 64 GiB
bomb = bytearray(packed([("X.npy", npy(np.zeros(4096)))]))
size = struct.pack("<I", 4096 * 8 + 128)
for at in (bomb.find(size), bomb.rfind(size)):
    bomb[at:at + 4] = struct.pack("<I", 0xFFFFFFF0)
put("bomb.npz", bytes(bomb))

# MATLAB 5 (packed and not); 7.3 is HDF5 and is read by the same library
for name, pack in (("stream.mat", False), ("stream_packed.mat", True)):
    out = io.BytesIO()
    scipy.io.savemat(out, {"X": x_mm, "C": c_deg.reshape(n, 1), "Z": z_mm, "note": "a shaft",
                           "points": points, "spectrum": points[:, 0] + 1j}, do_compression=pack)
    data = out.getvalue()
    data = b"MATLAB 5.0 MAT-file, made by scipy".ljust(116) + data[116:]  # without the date
    put(name, data)
    if not pack:
        put("cut.mat", data[:-100])

# MATLAB 7.3: HDF5 behind 512 bytes, columns as rows, the class as an attribute
place = os.path.join(folder, "stream_73.mat")
with h5py.File(place, "w", userblock_size=512, libver="earliest") as file:
    for name, values in (("X", x_mm), ("C", c_deg), ("Z", z_mm)):
        data = file.create_dataset(name, data=values.reshape(1, n), track_times=False)
        data.attrs["MATLAB_class"] = np.bytes_("double")
with open(place, "r+b") as file:
    file.write(b"MATLAB 7.3 MAT-file, made by h5py".ljust(116) + bytes(8) + b"\x00\x02IM")

# HDF5: units as attributes, a group, what is no table
def hdf5(fill):
    out = io.BytesIO()
    with h5py.File(out, "w", libver="earliest") as file:
        fill(file)
    return out.getvalue()


def with_units(file):
    run = file.create_group("run")
    for name, values, unit in (("X", x_mm / 1000, "m"), ("C", np.deg2rad(c_deg), "rad"),
                               ("Z", z_mm, "mm")):
        data = run.create_dataset(name, data=values, track_times=False)
        data.attrs["units"] = unit
    file.create_dataset("title", data="a shaft", track_times=False)


put("stream.h5", hdf5(with_units))


def cloud(file):
    data = file.create_dataset("cloud", data=points * 1000, track_times=False, chunks=(8, 3),
                               compression="gzip", fletcher32=True)
    data.attrs["unit"] = np.bytes_("um")
    file.create_dataset("waves", data=points + 1j, track_times=False)


put("points.h5", hdf5(cloud))
# As netCDF packs readings: whole numbers of 0.1 µm off 20 mm, one that is missing
def netcdf(file):
    x_um10 = np.round((x_mm - 20) / 1e-4).astype("<i4")
    x_um10[5] = -9999
    data = file.create_dataset("X", data=x_um10, track_times=False)
    data.attrs["units"] = "mm"
    data.attrs["scale_factor"] = np.array([1e-4])
    data.attrs["add_offset"] = 20.0
    data.attrs["_FillValue"] = np.int32(-9999)
    for name, values, unit in (("C", c_deg, "deg"), ("Z", z_mm, "mm")):
        file.create_dataset(name, data=values, track_times=False).attrs["units"] = unit


# A group for each pass, of another length
def passes(file):
    for group, rows in (("pass1", slice(0, 10)), ("pass2", slice(10, n))):
        for name, values, unit in (("X", x_mm, "mm"), ("C", c_deg, "deg"), ("Z", z_mm, "mm")):
            file.create_dataset(f"{group}/{name}", data=values[rows],
                                track_times=False).attrs["units"] = unit


put("packed.h5", hdf5(netcdf))
put("passes.h5", hdf5(passes))
put("no_units.h5", hdf5(lambda file: file.create_dataset("cloud", data=points, track_times=False)))
put("two_clouds.h5", hdf5(lambda file: [file.create_dataset(k, data=points, track_times=False)
                                        for k in ("first", "second")]))
put("only_complex.h5", hdf5(lambda file: file.create_dataset("waves", data=points + 1j,
                                                             track_times=False)))
put("cut.h5", hdf5(cloud)[:-700])
whole = bytearray(hdf5(cloud))
# A number of the packed data changed: deflate or the Fletcher sum tells
with h5py.File(io.BytesIO(bytes(whole)), "r") as file:
    where = file["cloud"].id.get_chunk_info(0).byte_offset
whole[where + 40] ^= 0x10
put("changed.h5", bytes(whole))
put("elsewhere.h5", hdf5(lambda file: file.create_dataset(
    "cloud", (n, 3), "<f8", external=[("/dev/zero", 0, h5py.h5f.UNLIMITED)])))
# Four data sets that say they hold 1 GiB of zeros each, in two kilobytes
put("sparse.h5", hdf5(lambda file: [file.create_dataset(k, (2 ** 27, 1), "<f8", chunks=(2 ** 20, 1))
                                    for k in "abcd"]))

# X3P, written after the schema of ISO 25178-72 with the standard library alone
xml = """<?xml version="1.0" encoding="UTF-8"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>{feature}</FeatureType><Axes>{axes}</Axes></Record1>
<Record3>{size}{data}</Record3>
<Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>
</p:ISO5436_2>
"""
absolute = "".join(f"<{k}><AxisType>A</AxisType><DataType>D</DataType></{k}>"
                   for k in ("CX", "CY", "CZ"))


def link(data, valid=None):
    text = ("<DataLink><PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>"
            f"{hashlib.md5(data).hexdigest()}</MD5ChecksumPointData>")
    if valid is not None:
        text += ("<ValidPointsLink>bindata/valid.bin</ValidPointsLink><MD5ChecksumValidPoints>"
                 f"{hashlib.md5(valid).hexdigest()}</MD5ChecksumValidPoints>")
    return text + "</DataLink>"


def x3p(main, data=None, valid=None, sum_of=None):
    main = main.encode()
    members = [("main.xml", main)]
    if data is not None:
        members.append(("bindata/data.bin", data))
    if valid is not None:
        members.append(("bindata/valid.bin", valid))
    members.append(("md5checksum.hex",
                    (hashlib.md5(sum_of or main).hexdigest() + " *main.xml\n").encode()))
    return packed(members)


data = (points / 1000).astype("<f8").tobytes()
list_of = f"<ListDimension>{n}</ListDimension>"
main = xml.format(feature="PCL", axes=absolute, size=list_of, data=link(data))
put("points.x3p", x3p(main, data))
put("cut.x3p", x3p(main, data)[:-30])
put("other_data.x3p", x3p(main, data[:-1] + b"\x00"))
put("other_xml.x3p", x3p(main, data, sum_of=b"another"))
put("too_many.x3p", x3p(main.replace(list_of, "<ListDimension>25</ListDimension>"), data))
put("endless.x3p", x3p(main.replace(list_of, "<ListDimension>99999999999999999999</ListDimension>"), data))
text = "<DataList>" + "".join(f"<Datum>{x!r};{y!r};{z!r}</Datum>" for x, y, z in
                              (points / 1000).tolist()) + "</DataList>"
put("points_in_xml.x3p", x3p(xml.format(feature="PCL", axes=absolute, size=list_of, data=text)))
# A surface of 5 x 4 heights in steps of 1 nm (int32), turned about z by 90 degrees, two of them invalid
heights = np.rint(1e3 * np.cos(np.arange(20))).astype("<i4").tobytes()
valid = bytes([0b11111011, 0b11111111, 0b00000111])
grid = ("<CX><AxisType>I</AxisType><Increment>1e-5</Increment><Offset>0.001</Offset></CX>"
        "<CY><AxisType>I</AxisType><Increment>2e-5</Increment></CY>"
        "<CZ><AxisType>A</AxisType><DataType>L</DataType><Increment>1e-9</Increment></CZ>"
        "<Rotation><r11>0</r11><r12>-1</r12><r13>0</r13><r21>1</r21><r22>0</r22><r23>0</r23>"
        "<r31>0</r31><r32>0</r32><r33>1</r33></Rotation>")
size = "<MatrixDimension><SizeX>5</SizeX><SizeY>4</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
put("surface.x3p", x3p(xml.format(feature="SUR", axes=grid, size=size, data=link(heights, valid)),
                       heights, valid))
