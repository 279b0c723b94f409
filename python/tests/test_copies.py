# SPDX-License-Identifier: Apache-2.0
"""What docs/how-to/use-from-python.md says about copies: which arrays are used as they are, and which arrays are views."""
import numpy as np
import pandas
import pytest

import trueaxis as ta
from trueaxis._streams import numbers_of

COUNT = 1000
FRESH = np.arange(2.0 * COUNT)


@pytest.mark.parametrize("name, array, used_as_it_is", [
    ("float64 in one piece", FRESH[:COUNT], True),
    ("a row of a table", FRESH.reshape(2, COUNT)[0], True),
    ("a read-only array", np.frombuffer(FRESH.tobytes()), True),
    ("float32", FRESH.astype(np.float32), False),
    ("whole numbers", FRESH.astype(np.int64), False),
    ("a column of a table", FRESH.reshape(COUNT, 2)[:, 0], False),
    ("every second value", FRESH[::2], False),
    ("the other byte order", FRESH.astype(">f8"), False),
    ("a masked array", np.ma.masked_greater(FRESH, 1e9), False),
    ("a Series", pandas.Series(FRESH), False),
])
def test_which_arrays_become_numbers_without_a_copy(name, array, used_as_it_is):
    assert np.shares_memory(numbers_of(name, array), np.asarray(array)) == used_as_it_is


def _stream_of(x):
    c = np.linspace(0.0, 40.0 * np.pi, COUNT)
    return ta.stream(x, c, np.linspace(0.0, 30.0, COUNT), x_unit="mm radius", c_unit="rad", z_unit="mm")


def test_a_stream_has_a_copy_of_its_arrays():
    x = 25.0 + 0.04 * np.cos(np.linspace(0.0, 40.0 * np.pi, COUNT))
    stream = _stream_of(x)
    assert not np.shares_memory(stream.reading_mm, x)
    x[:] = 0.0
    assert stream.reading_mm.min() > 24.0


def test_arrays_of_streams_and_results_are_views_that_outlive_their_owner():
    stream = _stream_of(25.0 + 0.04 * np.cos(np.linspace(0.0, 40.0 * np.pi, COUNT)))
    fit = ta.fit(stream, surface="cylinder")
    for owner, name in [(stream, "reading_mm"), (stream, "c_rad"), (stream, "position_mm"), (fit, "residual_mm")]:
        assert np.shares_memory(getattr(owner, name), getattr(owner, name)), name
        assert not getattr(owner, name).flags.writeable, name
    assert fit.stream is stream
    residual, before = fit.residual_mm, fit.residual_mm.copy()
    del fit, stream, owner
    assert np.array_equal(residual, before)
