"""The tables of docs/results.md are what pairsum_results computes from the committed rows.

PAIRSUM_WRITE=1 writes them anew, each between `<!-- table NAME -->` and `<!-- end -->`."""
import functools
import os
import re

import pandas as pd
import pytest
from conftest import ROOT

import pairsum_results as pr

DOCUMENT = ROOT / "docs/results.md"
BLOCK = re.compile(r"^<!-- table (\w+) -->\n(.*?)^<!-- end -->$", re.MULTILINE | re.DOTALL)
EVALUATION = "evaluation_s"
CASES = {"dam_break": "dense", "periodic_lattice": "dense periodic", "random_clustered": "clustered"}


@functools.lru_cache
def rows(study, revision=""):
    """The committed study of this name, at this revision if it has several, with its ladder."""
    (file,) = (ROOT / "results" / study).glob(f"*-{revision}*.jsonl")
    results = pr.load([file])
    return results, pr.ladder(results)


def table(head, lines):
    """A Markdown table."""
    return "".join(f"| {' | '.join(str(cell) for cell in line)} |\n" for line in [head, ["---"] * len(head), *lines])


def interval(line, name="ratio"):
    low, high = ("low", "high") if name == "ratio" else (f"{name}_low", f"{name}_high")
    return f"{line[name]:.2f} [{line[low]:.2f}, {line[high]:.2f}]" if pd.notna(line[name]) else ""


def ms(seconds):
    return f"{1e3 * seconds:.1f} ms" if seconds < 0.1 else f"{1e3 * seconds:.0f} ms"


def particles(point):
    """What a person calls the particles of this point, with interacting pairs a particle."""
    name, pairs = CASES[point["case"]], point["pairs_interacting"] / point["n_fluid"]
    return f"{'sparse' if pairs < 2 else name}, {point['dim']}D, {pairs:.1f} pairs"


def reading_order(text):
    """Key that sorts what `particles` returns: 3D before 2D, dense before sparse, few pairs before many."""
    name, dim, pairs = re.fullmatch(r"(.*), (\d)D, (.*) pairs", text).groups()
    return -int(dim), [*CASES.values(), "sparse"].index(name), float(pairs)


def names(backends):
    return ", ".join(f"`{name}`" for name in backends) or "-"


def winners(study, where):
    """A line per ladder: the fastest backend, its ratio, what could not be told from it, the best of scalar code."""
    results, ladder = rows(study)
    ladders = [group.sort_values("time_s") for _, group in ladder.query(where).groupby(["series", "at"], sort=False)]
    pairs = [(group["point"].iloc[0], point) for group in ladders for point in group["point"].iloc[1:]]
    ratios = pr.compared(results, [base for base, _ in pairs], [point for _, point in pairs], EVALUATION)
    ties = ratios[ratios["verdict"] == "not resolved"].groupby("base")["backend"].agg(list)
    lines = []
    for group in ladders:
        best, scalar = group.iloc[0], group[group["isa"] == "scalar"]
        line = [particles(results.points.loc[best["point"]]), best["base_threads"], f"`{best['backend']}`", interval(best),
                ms(best["base_time_s"]), names(ties.get(best["point"], []))]
        lines.append(line + ([f"`{scalar.iloc[0]['backend']}` {interval(scalar.iloc[0])}"] if study == "field" else []))
    return sorted(lines, key=lambda line: (reading_order(line[0]), line[1]))


def what_to_take():
    return table(["particles", "threads", "take", "times as fast as `naive_omp`", "time of `naive_omp`", "not resolved from it",
                  "best scalar code"], winners("field", "rank > 0"))


def what_to_take_on_vector_units():
    return table(["particles", "threads", "take", "times as fast as `naive_omp`", "time of `naive_omp`",
                  "not resolved from it"], winners("lanes", "at == 'most_threads'"))


def ladders(study, at, name="ratio"):
    """A line per backend, a column per world."""
    results, ladder = rows(study)
    ladder = ladder[ladder["at"] == at].sort_values("rank")
    worlds = ladder.drop_duplicates("series").set_index("series")
    worlds["name"] = [particles(results.points.loc[point]) for point in worlds["point"]]
    worlds = worlds.sort_values("name", key=lambda names: names.map(reading_order))
    cells = {key: interval(line, name) for key, line in ladder.set_index(["backend", "series"]).iterrows()}
    means = ladder.groupby("backend")[name].mean().sort_values(ascending=name != "ratio").dropna()
    lines = [[f"`{backend}`", *(cells.get((backend, series), "") for series in worlds.index)] for backend in means.index]
    bases = ["time of the base", *(ms(time) for time in worlds["base_time_s"])] if name == "ratio" else []
    return table(["backend", *worlds["name"]], [bases] * bool(bases) + lines)


def over(results, **words):
    """Positions of the points with these words."""
    points = results.points
    for key, value in words.items():
        points = points[points[key] == value]
    return points.index


def vector_gain():
    """Scalar over vector units, the same backend, and the same two strategies against each other on either."""
    results, _ = rows("lanes")
    worlds = [over(results, series=series) for series in sorted(results.points["series"].unique())]

    def point(world, backend, isa):
        return world[(results.points.loc[world, ["backend", "isa", "threads"]] == [backend, isa, 2]).all(axis=1)][0]

    asked = [(f"`{name}`: scalar over vector", (name, "scalar"), (name, "avx512"))
             for name in ["naive_omp", "sliced_2colour", "symmetric_omp", "pair_list_omp", "half_cells"]]
    asked += [(f"`naive_omp` over `{name}`, {word}", ("naive_omp", isa), (name, isa))
              for name in ["symmetric_omp", "sliced_2colour"] for word, isa in [("scalar", "scalar"), ("vector", "avx512")]]
    asked += [("`tiles_omp` over `sliced_2colour`, vector", ("tiles_omp", "avx512"), ("sliced_2colour", "avx512"))]
    ends = [(point(world, *base), point(world, *other)) for _, base, other in asked for world in worlds]
    ratios = pr.compared(results, [base for base, _ in ends], [other for _, other in ends], EVALUATION)
    cells = [interval(line) for _, line in ratios.iterrows()]
    head = ["ratio of times", *(particles(results.points.loc[world[0]]) for world in worlds)]
    return table(head, [[asked[k][0], *cells[k * len(worlds):(k + 1) * len(worlds)]] for k in range(len(asked))])


STATES = ["rest", "perturbed", "evolved:0.5"]


@functools.lru_cache
def densities():
    """The table density of the study, with `radius`: H in spacings, as the study has it."""
    results, _ = rows("density")
    found = pr.density(results)
    points = results.points.loc[found["point"], ["H", "dx", "state", "precision"]].set_index(found.index)
    return results, found.assign(radius=(points["H"] / points["dx"]).round(2), state=points["state"],
                                 precision=points["precision"])


def density_fastest():
    """Double precision, 1 thread: the fastest of all backends at every number of pairs, lattice first."""
    results, found = densities()
    found = found[(found["precision"] == "double") & (found["threads"] == 1)]
    lines = []
    for (state, radius), some in sorted(found.groupby(["state", "radius"]), key=lambda item: (STATES.index(item[0][0]), item[0][1])):
        best = some.loc[some["time_s"].idxmin()]
        alike = results.points[(results.points["series"] == best["series"]) & (results.points["threads"] == 1)].index
        others = [p for p in alike if p != best["point"]]
        against = pr.compared(results, [best["point"]] * len(others), others, EVALUATION)
        ties = against[against["verdict"] == "not resolved"].sort_values("time_s")
        lines.append([state, f"{radius:g}", f"{best['pairs_per_particle']:.0f}", f"`{best['backend']}`",
                      f"{best['ns_per_pair']:.1f}", pr.compare.first_few([f"`{name}`" for name in ties["backend"]], 3)])
    return table(["state", "H / dx", "pairs", "fastest", "ns per pair", "not resolved from it"], lines)


def density_worth():
    """The fastest gather over the fastest backend that computes each pair once, double precision, 1 thread."""
    _, found = densities()
    found = found[(found["precision"] == "double") & (found["threads"] == 1) & found["fastest_symmetric"]]
    radii = sorted(found["radius"].unique())
    cells = {key: interval(line) for key, line in found.set_index(["state", "units", "radius"]).iterrows()}
    return table(["state", "units", *(f"H = {radius:g} dx" for radius in radii)],
                 [[state, units, *(cells[state, units, radius] for radius in radii)]
                  for units in ("scalar", "vector") for state in STATES])


def density_precisions():
    """After the flow: ns per pair of the fastest backend."""
    _, found = densities()
    found = found[found["state"].str.startswith("evolved")]
    best = found.loc[found.groupby(["precision", "units", "threads", "radius"])["time_s"].idxmin()]
    radii = sorted(best["radius"].unique())
    cells = {key: f"{line['ns_per_pair']:.2f} `{line['backend']}`" for key, line in
             best.set_index(["precision", "units", "threads", "radius"]).iterrows()}
    return table(["precision", "units", "threads", *(f"H = {radius:g} dx" for radius in radii)],
                 [[precision, units, threads, *(cells[precision, units, threads, radius] for radius in radii)]
                  for precision in ("double", "mixed", "float") for units in ("scalar", "vector") for threads in (1, 2)
                  if (precision, units, threads, radii[0]) in cells])


def full_size():
    """Study `vector`: sums at full size, M = 9."""
    results, _ = rows("vector")

    def line(name, precision, state, base=None):
        of_base = {"precision": "double" if precision == "mixed" and base and "tiles" not in base else precision}
        cells = []
        for threads in (1, 2):
            words = {"state": state, "grid": "hashed_grid", "M": 9, "threads": threads}
            one = over(results, backend=name, precision=precision, **words)[0]
            if base is None:
                cells.append(ms(results.points.loc[one, "sum_s"]))
            else:
                other = over(results, backend=base, **of_base, **words)[0]
                cells.append(interval(pr.compared(results, [other], [one]).iloc[0]))
        what = f"`{name}`" if base is None else f"`{base}`{', double,' * (of_base['precision'] != precision)} over `{name}`"
        return [what, precision, state, *cells]

    times = [line(name, precision, "perturbed") for precision in ("double", "mixed", "float")
             for name in ("naive_omp", "symmetric_omp", "naive_tiles_omp", "tiles_omp")
             if precision != "mixed" or "tiles" in name]
    ratios = [line("tiles_omp", precision, state, base) for base in ("symmetric_omp", "naive_omp", "naive_tiles_omp")
              for precision, state in (("double", "rest"), ("double", "perturbed"), ("mixed", "perturbed"), ("float", "perturbed"))]
    return table(["time or ratio", "precision", "state", "1 thread", "2 threads"], times + ratios)


def instruction_sets_and_blocks():
    results, _ = rows("vector")
    grid = {"grid": "compact_grid", "threads": 2, "backend": "tiles_omp"}
    base = over(results, isa="avx512", block="auto", **grid)[0]
    others = [p for p in over(results, **grid) if p != base]
    ratios = pr.compared(results, others, [base] * len(others))
    points = results.points.loc[others]
    return table(["changed", "times as long as `avx512`, `auto` (made `pencil:8`)", "verdict on the choice"],
                 [[f"isa `{isa}`" if isa != "avx512" else f"block `{block}`", interval(line), {
                     "faster": "slower", "slower": "faster"}.get(line["verdict"], line["verdict"])]
                  for isa, block, (_, line) in zip(points["isa"], points["block"], ratios.iterrows())])


def talk(revision):
    results, _ = rows("talk", revision)
    points = results.points.query("state == 'rest' and grid == 'hashed_grid' and threads <= 2")
    cells = {(p["backend"], p["threads"], p["M"]): f"{1e3 * p['sum_s']:.0f} [{1e3 * p['sum_s_low']:.0f}, {1e3 * p['sum_s_high']:.0f}]"
             for _, p in points.iterrows()}
    backends = ["naive_omp", "symmetric_omp", "naive_tbb", "symmetric_tbb"]
    columns = [(threads, M) for threads in (1, 2) for M in (6, 7)]
    return table(["ms per sum", *(f"{threads} thread{'s' * (threads > 1)}, M = {M}" for threads, M in columns)],
                 [[f"`{name}`", *(cells[name, *column] for column in columns)] for name in backends])


def talk_claims(revision):
    results, _ = rows("talk", revision)
    twice = pr.algorithm_speedup(results).query("M == base_M")
    twice = twice[results.points.loc[twice["point"], "state"].eq("rest").to_numpy()]
    lines = [[f"`{x['base_backend']}` over `{x['backend']}`, M = {x['M']:.0f}, {x['threads']} thread{'s' * (x['threads'] > 1)}",
              interval(x), x["rounds"], x["verdict"]] for _, x in twice.iterrows()]
    scaling = pr.speedup(results).query("threads == 2 and M == M")
    lines += [[f"`{x['backend']}`, M = {x['M']:.0f}: 1 thread over 2", interval(x), x["rounds"], x["verdict"]]
              for _, x in scaling.iterrows()]
    return table(["ratio of times", "value", "rounds", "verdict"], lines)


def talk_fastest():
    """The talk's particles on 2 threads and compact_grid: the fastest strategies against scalar naive_omp."""
    results, _ = rows("talk", "fa9ddd4")
    points = over(results, grid="compact_grid", threads=2)
    base = over(results, grid="compact_grid", threads=2, backend="naive_omp", isa="scalar")[0]
    ratios = pr.compared(results, [base] * len(points), points, "total_s").sort_values("time_s")
    return table(["backend", "isa", "ms per sum", "ms per step", "times as fast as scalar `naive_omp`, whole step"],
                 [[f"`{x['backend']}`", x["isa"], f"{1e3 * results.points.loc[x['point'], 'sum_s']:.0f}",
                   f"{1e3 * x['time_s']:.0f}", interval(x)] for _, x in ratios.iterrows()])


def hash_sizes():
    results, _ = rows("m_sweep", "fa9ddd4")
    lines = []
    for _, x in pr.m_comparison(results).query("series == 0").iterrows():
        lines.append([f"`{x['backend']}`", f"{x['M']:.0f}", f"{1e3 * x['sum_s']:.0f}", f"{100 * x['collision_share']:.0f} %",
                      x["verdict"] if x["M"] != x["base_M"] else "best"])
    return table(["backend", "M", "ms per sum", "distance tests from hash collisions", "whole step, against the best M"], lines)


def self_test():
    found = pr.self_test(rows("self_test")[0])
    return table(["known", "base", "threads", "expected", "found", "holds"],
                 [[x["what"], f"`{x['base_backend']}`", x["threads"], "refused" if pd.isna(x["expected"]) else f"{x['expected']:.2f}",
                   interval(x) or "refused", "yes" if x["holds"] else "no"] for _, x in found.iterrows()])


TABLES = {
    "take": what_to_take, "take_vector": what_to_take_on_vector_units,
    "field": lambda: ladders("field", "most_threads"), "field_serial": lambda: ladders("field", "one_thread", "over_serial"),
    "lanes": lambda: ladders("lanes", "most_threads"), "vector_gain": vector_gain, "full_size": full_size,
    "density_fastest": density_fastest, "density_worth": density_worth, "density_precisions": density_precisions,
    "sets_and_blocks": instruction_sets_and_blocks, "talk_now": lambda: talk("fa9ddd4"), "talk_now_claims": lambda: talk_claims("fa9ddd4"), "talk_fastest": talk_fastest,
    "talk": lambda: talk("8a2a02c"), "talk_claims": lambda: talk_claims("8a2a02c"), "hash_sizes": hash_sizes,
    "self_test": self_test,
}


def wrong(text, tables=TABLES):
    """Names of the tables that `text` lacks, has twice, or has with other contents than they are made with."""
    found = BLOCK.findall(text)
    return [name for name, make in tables.items() if [body for word, body in found if word == name] != [make()]]


def up_to_date(document, tables):
    """The document's text, its tables written anew if PAIRSUM_WRITE says so."""
    text = document.read_text()
    if os.environ.get("PAIRSUM_WRITE"):
        text = BLOCK.sub(lambda block: f"<!-- table {block[1]} -->\n{tables[block[1]]()}<!-- end -->", text)
        document.write_text(text)
    return text


def test_tables_are_what_the_rows_say():
    assert wrong(up_to_date(DOCUMENT, TABLES)) == []


def test_every_table_is_known():
    assert {name for name, _ in BLOCK.findall(DOCUMENT.read_text())} == set(TABLES)


@pytest.mark.parametrize("change", [lambda text: text.replace("3.17 [3.07", "3.18 [3.07"),
                                    lambda text: text.replace("<!-- table take -->", "")])
def test_another_number_is_found(change):
    assert "take" in wrong(change(DOCUMENT.read_text()))


def test_what_info_tells_to_expect_is_what_was_found():
    """Where pairs are few, and on vector units and 2 threads the five that are fastest on the whole."""
    said = re.sub(r'"\s+"', "", (ROOT / "harness/cli/info_command.cpp").read_text())
    few = re.search(r'"expect (\w+) in front, which keeps', said)[1]
    many = re.search(r'"expect ([\w, ]+) on vector units in front', said)[1]
    field, ladder = rows("field")
    pairs = (field.points["pairs_interacting"] / field.points["n_fluid"]).where(field.points["dim"] == 3)
    sparse = ladder[(pairs.loc[ladder["point"]] < 3).to_numpy() & (ladder["rank"] == 1)]
    assert set(sparse["backend"]) == {few}
    results, _ = rows("density")
    points = results.points.assign(time=results.typical(EVALUATION)).query(
        "threads == 2 and precision == 'double' and isa != 'scalar'")
    over_best = points["time"] / points.groupby("H")["time"].transform("min")
    means = over_best.groupby(points["backend"]).mean().sort_values()
    assert set(many.split(", ")) == set(means.index[:5])
