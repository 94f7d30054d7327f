#!/usr/bin/env python3
"""A classifier for Seamline in Python: clusters of curvature by BIRCH, of scikit-learn.

    seamline segment part.stl --classifier '{ command = ["python3", "birch.py"], send = ["samples"] }'

Needs pyarrow, numpy and scikit-learn. It stays for mesh after mesh, until its input ends.
"""

import sys

import numpy as np
import pyarrow as pa
from sklearn.cluster import Birch

# Two samples nearer than this are one cluster: half of it is a ratio of radii of 1.16.
WIDTH = 0.3


def meshes(stream):
    """The tables of each mesh, by name, until the input ends."""
    while True:
        tables = {}
        names = None
        while names is None or len(tables) < len(names):
            try:
                reader = pa.ipc.open_stream(stream)
            except pa.ArrowInvalid:
                return
            about = reader.schema.metadata
            names = about[b"seamline.tables"].split(b",")
            tables[about[b"seamline.table"].decode()] = reader.read_all()
        yield tables


def answer(stream, column, numbers):
    """One stream with one column."""
    table = pa.table({column: pa.array(numbers, type=pa.uint32())})
    with pa.ipc.new_stream(stream, table.schema) as writer:
        writer.write_table(table)
    stream.flush()


def classify(samples):
    features = np.column_stack([samples["feature_0"], samples["feature_1"]])
    if len(features) == 0:
        return np.zeros(0, dtype=np.uint32)
    # Of a million samples a few thousand are distinct.
    distinct, which = np.unique(np.round(features, 3), axis=0, return_inverse=True)
    clusters = Birch(threshold=WIDTH, n_clusters=None).fit_predict(distinct)
    return np.unique(clusters[which.ravel()], return_inverse=True)[1].astype(np.uint32)


if __name__ == "__main__":
    for tables in meshes(sys.stdin.buffer):
        clusters = classify(tables["samples"])
        print(f"{len(clusters)} samples, {len(set(clusters))} clusters", file=sys.stderr)
        answer(sys.stdout.buffer, "cluster", clusters)
