"""Predictions for many ranks: against counted random particles, against the formula by hand, and in docs/model.md.

PAIRSUM_WRITE=1 writes the document's tables anew; the C++ test of the closed forms reads the first, too."""
import math

import numpy as np
import pytest
from conftest import ROOT
from test_results_document import BLOCK, table, up_to_date, wrong

from pairsum_results.rank_model import RANKS, cuts, predictions, share

DOCUMENT = ROOT / "docs/model.md"
LINK = {"latency_s": 2e-6, "bandwidth_bytes_per_s": 1e10}
COSTS = {"s_per_particle": 2e-8, "s_per_pair": 2e-9}
WORLD = {"particles": 1e6, "pairs_per_particle": 40}
REACH = (60 / math.pi)**(1 / 3)  # a ball of 80 particles


def lattice(n, reach):
    """Ghosts per particle and cut share of a cube of n^3 particles, by offsets."""
    far = range(-math.floor(reach), math.floor(reach) + 1)
    offsets = [(x, y, z) for x in far for y in far for z in far if 0 < x * x + y * y + z * z < reach * reach]
    kept = sum(math.prod(n - abs(o) for o in offset) for offset in offsets)
    return (1 + 2 * math.floor(reach + 0.5) / n)**3 - 1, 1 - kept / (n**3 * len(offsets))


def shares():
    """Ghosts per particle and cut pairs of usual ranks."""
    lines = []
    for n in (46, 100):
        for reach in (2, 4.16):
            mean = share((4 * n)**3, reach, [4, 4, 4])
            ghosts, cut = lattice(n, reach)
            lines.append([f"{n}^3", f"{reach:g} dx", f"{ghosts:.3f}", f"{mean['ghosts'] / mean['own']:.3f}",
                          f"{100 * cut:.2f} %", f"{100 * mean['cut_share']:.2f} %"])
    return table(["particles of a rank", "H", "ghosts per particle, lattice", "mean", "cut pairs of all, lattice",
                  "mean"], lines)


def example():
    """What the model says of given costs."""
    some = predictions(LINK, COSTS, **WORLD, ranks=(1, 8, 64, 512, 4096))
    by = some.set_index(["scaling", "mode", "ranks"])["efficiency"]
    columns = [(scaling, mode) for scaling in ("strong", "weak") for mode in ("twice", "once")]
    return table(["ranks", *(f"{scaling} scaling, `{mode}`" for scaling, mode in columns)],
                 [[n, *(f"{by[scaling, mode, n]:.2f}" for scaling, mode in columns)] for n in some["ranks"].unique()])


TABLES = {"shares": shares, "example": example}


def test_the_tables_of_the_document_are_computed():
    assert wrong(up_to_date(DOCUMENT, TABLES), TABLES) == []


def test_another_number_is_found():
    text = DOCUMENT.read_text()
    number = BLOCK.search(text)[2].rsplit(" % |", 1)[0][-4:]
    assert wrong(text.replace(number, "9.99", 1), TABLES) == ["shares"]
    assert wrong("", TABLES) == ["shares", "example"]


@pytest.mark.parametrize("parts, skin", [([2, 1, 1], 0), ([2, 2, 1], 0.1), ([3, 2, 2], 0.1), ([3, 3, 3], 0)])
def test_shares_are_those_of_random_particles(parts, skin):
    """Of 1500 random particles in a periodic cube: those of one rank, its ghosts, and their pairs."""
    n, reach, draws = 1500, 3.4, 4 * math.prod(parts)
    edge, random = n**(1 / 3), np.random.default_rng(2009)
    box = edge / np.array(parts)
    counts = []
    for _ in range(draws):
        x = random.uniform(0, edge, (n, 3))
        own = (x < box).all(axis=1)
        outside = np.minimum(np.maximum(x - box, 0), edge - x)  # the nearer way around
        near = (np.where(x < box, 0, outside) <= reach * (1 + skin)).all(axis=1)
        apart = np.abs(x[own][:, None] - x[None])
        close = (np.minimum(apart, edge - apart)**2).sum(axis=2) < reach**2
        counts.append([own.sum(), (near & ~own).sum(), close[:, ~own].sum(), close.sum() - own.sum()])
    own, ghosts, cut, partners = np.mean(counts, axis=0)
    said = share(n, reach, parts, skin)
    assert own == pytest.approx(said["own"], rel=0.03)
    assert ghosts == pytest.approx(said["ghosts"], rel=0.03)
    assert cut / partners == pytest.approx(said["cut_share"], rel=0.03)


def test_cuts_halve_one_axis_after_the_other():
    assert [cuts(n) for n in (1, 2, 4, 8, 16)] == [[1, 1, 1], [2, 1, 1], [2, 2, 1], [2, 2, 2], [4, 2, 2]]
    assert cuts(4096) == [16, 16, 16]
    assert [share(1e6, 2, cuts(n))["neighbours"] for n in (1, 2, 4, 8, 16, 64)] == [0, 1, 3, 7, 11, 26]
    for n in (0, 3, 12, -4):
        with pytest.raises(ValueError, match=f"1, 2, 4, 8, ... ranks, not {n}"):
            cuts(n)


def test_a_time_is_work_and_messages():
    found = predictions(LINK, COSTS, **WORLD, particle_bytes=100, rates_bytes=50)
    assert set(found["source"]) == {"model"} and len(found) == 2 * 2 * len(RANKS)
    one = found[found["ranks"] == 1]
    assert one["time_s"].to_numpy() == pytest.approx(1e6 * (2e-8 + 40 * 2e-9)) and (one["bytes"] == 0).all()
    assert one["efficiency"].to_numpy() == pytest.approx(1)
    own = 1e6 / 64
    ghosts, partners = (25 + 2.2 * REACH)**3 - 25**3, 80 * own
    cut = share(1e6, REACH, [4, 4, 4])["cut_share"] * partners
    for mode, pairs, messages, size in (("twice", partners / 2 + cut / 2, 26, 100), ("once", partners / 2, 52, 150)):
        row = found.query("scaling == 'strong' and ranks == 64 and mode == @mode").iloc[0]
        assert row["cut_pairs"] == pytest.approx(cut) and row["messages"] == messages
        time = 2e-8 * (own + ghosts) + 2e-9 * pairs + messages * 2e-6 + ghosts * size / 1e10
        assert row["time_s"] == pytest.approx(time)
        assert row["efficiency"] == pytest.approx(1e6 * 1e-7 / time / 64)
    weak = found.query("scaling == 'weak' and mode == 'twice'").set_index("ranks")
    assert (weak["particles_per_rank"].round() == 1e6).all()
    assert weak.loc[[1, 2, 4, 8, 64], "efficiency"].is_monotonic_decreasing
    assert weak.loc[64, "time_s"] == pytest.approx(weak.loc[4096, "time_s"])


def test_which_mode_is_faster_depends_on_the_costs():
    def once_is_faster(link, costs):
        time = predictions(link, costs, **WORLD, ranks=[64]).query("scaling == 'strong'").set_index("mode")["time_s"]
        return time["once"] < time["twice"]
    assert once_is_faster(LINK, {**COSTS, "s_per_pair": 1e-7})
    assert not once_is_faster({**LINK, "latency_s": 1e-3}, COSTS)


def test_nothing_is_said_of_boxes_narrower_than_the_cutoff():
    found = predictions(LINK, COSTS, particles=1000, pairs_per_particle=40, reach=3, skin=0)
    found = found.query("scaling == 'strong'")
    assert (found["time_s"].isna() == (found["ranks"] > 8)).all()  # boxes of 16 are 10 / 4 wide
    found = predictions(LINK, COSTS, particles=1000, pairs_per_particle=40, reach=3, skin=0.7)
    assert found["time_s"].isna().sum() == 2 * (len(RANKS) - 1)


@pytest.mark.parametrize("change, said", [
    ({"link": {**LINK, "latency_s": -1e-6}}, "latency_s should be positive and finite, is -1e-06"),
    ({"link": {**LINK, "bandwidth_bytes_per_s": 0}}, "bandwidth_bytes_per_s should be positive"),
    ({"costs": {**COSTS, "s_per_pair": math.nan}}, "s_per_pair should be positive and finite, is nan"),
    ({"particles": math.inf}, "particles should be"),
    ({"skin": -0.1}, "skin should be finite and not negative, is -0.1"),
    ({"reach": 40}, "at least 3 cutoffs wide, 120 spacings, this one 100")])
def test_wrong_arguments_are_refused(change, said):
    with pytest.raises(ValueError, match=said):
        predictions(**{"link": LINK, "costs": COSTS, **WORLD, **change})
