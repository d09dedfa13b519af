"""A run as pandas tables: columns of series.csv over time, and the grains at the end.

python to_pandas.py [SCENE]
"""

import sys

import orzo
import pandas as pd
from plot_angle import BED


def main(path=None):
    with orzo.Scene(path, text=None if path else BED, settings={"time.taps": 4}) as scene:
        series = pd.DataFrame(scene.row() for _ in scene.times(every=scene.period / 4)).set_index("time")
        grains = pd.DataFrame(scene.position, columns=["x", "y", "z"])
        grains["diameter"] = scene.diameter
        contacts = scene.contacts()
        touching = pd.Series(contacts["a"][contacts["b"] >= 0]).value_counts()
        grains["contacts_as_first"] = grains.index.map(touching).fillna(0).astype(int)
    print(series[["tap", "angle", "contact_count"]].tail())
    print(grains.describe().loc[["mean", "min", "max"]])
    return series, grains


if __name__ == "__main__":
    main(*sys.argv[1:])
