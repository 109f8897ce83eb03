#!/usr/bin/env python3
"""Writes a series of DICOM files with pydicom, and what is in it.

Usage: dicom_series.py FOLDER [uneven | tilted | divided | compressed]. Debian has it as python3-pydicom. FOLDER/series gets an oblique scan of signed
16-bit samples with slope and intercept, its slices in files whose names do not tell their order, and beside it a
shorter series of the same patient. FOLDER/expected.json gets dimensions, the SHA-256 of the samples as doubles (x
fastest), and the map from index to world in three rows, computed as the standard says. With `uneven` the last slice is
farther off than the others, with `tilted` each slice is shifted within its plane, as of a CT with a tilted gantry; with `divided` two slices state another thickness; with `compressed` the
pixels are encoded by run lengths.
"""
import hashlib
import json
import os
import sys

import numpy
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.uid import ExplicitVRLittleEndian, RLELossless

FOLDER = sys.argv[1]
HOW = sys.argv[2] if len(sys.argv) > 2 else ""
UNEVEN, TILTED, DIVIDED, COMPRESSED = (HOW == kind for kind in ("uneven", "tilted", "divided", "compressed"))
ROOT = "1.2.826.0.1.3680043.8.498."  # pydicom's, for examples
MR = "1.2.840.10008.5.1.4.1.1.4"
RANDOM = numpy.random.RandomState(1)
COLUMNS, ROWS, SLICES = 7, 6, 5
ROW_STEP, COLUMN_STEP, SLICE_STEP = 1.5, 0.75, 2.5  # between rows, between columns, between slices
SLOPE, INTERCEPT = 0.5, -1024
ORIGIN = numpy.array([-90.5, 20.25, 133.0])
ALONG_ROW = numpy.array([0.6, 0.8, 0.0])  # the direction in which the column grows
ALONG_COLUMN = numpy.array([0.48, -0.36, -0.8])
NORMAL = numpy.cross(ALONG_ROW, ALONG_COLUMN)
STEP = SLICE_STEP * NORMAL + (0.6 if TILTED else 0) * ALONG_COLUMN  # from slice to slice


def write_slice(path, stored, series, number, origin):
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = MR
    meta.MediaStorageSOPInstanceUID = "%s%d.%d" % (ROOT, series, number + 1)
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    meta.ImplementationClassUID = ROOT + "9"
    data = FileDataset(path, {}, file_meta=meta, preamble=b"\0" * 128)
    data.is_little_endian, data.is_implicit_VR = True, False
    data.SOPClassUID, data.SOPInstanceUID = MR, meta.MediaStorageSOPInstanceUID
    data.Modality, data.PatientName, data.PatientID = "MR", "Nobody", "0"
    data.StudyInstanceUID, data.SeriesInstanceUID = ROOT + "7", "%s%d" % (ROOT, series)
    data.FrameOfReferenceUID = ROOT + "8"
    data.SeriesNumber, data.InstanceNumber = series, number + 1
    data.Rows, data.Columns = stored.shape
    data.PixelSpacing = [ROW_STEP, COLUMN_STEP]
    data.SliceThickness = SLICE_STEP * (2 if DIVIDED and number < 2 else 1)
    data.ImageOrientationPatient = [*map(float, ALONG_ROW), *map(float, ALONG_COLUMN)]
    data.ImagePositionPatient = [round(float(v), 6) for v in origin]
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 16, 16, 15, 1
    data.RescaleSlope, data.RescaleIntercept = SLOPE, INTERCEPT
    data.PixelData = stored.astype("<i2").tobytes()
    if COMPRESSED:
        data.compress(RLELossless)
    data.save_as(path, write_like_original=False)


def main():
    os.makedirs(os.path.join(FOLDER, "series"))
    stored = RANDOM.randint(-2000, 2000, size=(SLICES, ROWS, COLUMNS))
    names = RANDOM.permutation(SLICES)
    for k in range(SLICES):
        step = k + (0.5 if UNEVEN and k == SLICES - 1 else 0)
        write_slice(os.path.join(FOLDER, "series", "I%d" % names[k]), stored[k], 1, k, ORIGIN + step * STEP)
    for k in range(2):
        write_slice(os.path.join(FOLDER, "series", "A%d.dcm" % k), stored[k] // 2, 2, k, ORIGIN + k * STEP)
    samples = (stored * SLOPE + INTERCEPT).astype("<f8")
    affine = numpy.stack([COLUMN_STEP * ALONG_ROW, ROW_STEP * ALONG_COLUMN, STEP, ORIGIN], axis=1)
    with open(os.path.join(FOLDER, "expected.json"), "w") as out:
        json.dump({"dims": [COLUMNS, ROWS, SLICES], "sha256": hashlib.sha256(samples.tobytes()).hexdigest(),
                   "index_to_world": affine.tolist()}, out)


main()
