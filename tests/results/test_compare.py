"""Comparisons, ladders and answers of rows with known effects."""
import made
import numpy as np
import pytest

import pairsum_results as pr
from pairsum_results import answers, summary


@pytest.fixture
def report(tmp_path):
    """The report of made rows."""
    def of(points, **how):
        return pr.report(pr.load([made.write(tmp_path / "talk/rows.jsonl", made.study(points, **how))]))
    return of


def only(table, **where):
    found = table[(table[list(where)] == list(where.values())).all(axis=1)] if where else table
    assert len(found) == 1, found
    return found.iloc[0]


def test_every_comparison_finds_the_factor_that_was_put_in(report):
    r = report(made.talk(), before=[made.environment(), made.peak(1, 1e9, 1e10), made.peak(2, 1.8e9, 1.5e10)])
    two = only(r.speedup, backend="naive_omp", threads=2)
    assert (two["ratio"], two["low"], two["high"]) == pytest.approx((2, 2, 2)) and two["verdict"] == "faster"
    assert (two["efficiency"], two["machine_flops_scaling"], two["rounds"]) == (pytest.approx(1), pytest.approx(1.8), 6)
    assert (two["time_s"], two["base_time_s"]) == pytest.approx((0.5 * made.MEDIAN, made.MEDIAN))
    assert only(r.speedup, backend="naive_omp", threads=1)["verdict"] == "not resolved"  # the base itself
    assert set(r.speedup["backend"]) == {"naive_omp", "naive_tbb", "symmetric_omp", "symmetric_tbb"}
    assert only(r.algorithm_speedup, runtime="omp", threads=2)["ratio"] == pytest.approx(2)
    assert only(r.algorithm_speedup, runtime="serial", M=6, base_M=7)["ratio"] == pytest.approx(1.8)
    assert len(r.algorithm_speedup) == 3 + 4
    for e in r.runtime_comparison.itertuples():
        assert e.ratio == pytest.approx(0.8) and e.verdict == "slower" and e.base_backend == f"{e.algorithm}_omp"
    naive = only(r.m_comparison, backend="naive", M=6)
    assert (naive["best_M"], naive["over_best"], naive["verdict"]) == (7, pytest.approx(1 / 0.9), "slower")
    assert (naive["collision_share"], naive["useful_pair_ratio"]) == (0.25, 0.25)


def test_a_difference_in_the_scatter_is_not_resolved(report):
    a, b = (0.3, -0.3, 0.2, -0.2, 0.1, -0.1), (-0.2, 0.3, -0.1, 0.1, -0.3, 0.2)
    r = report([(made.point("naive"), 1.0, made.scattered(*a)), (made.point("symmetric"), 0.95, made.scattered(*b))])
    e = only(r.algorithm_speedup)
    assert e["ratio"] == pytest.approx(1 / 0.95) and e["low"] < 1 < e["high"] and e["verdict"] == "not resolved"


def test_the_machines_own_pace_is_set_against_speedups(report):
    paces = [made.pace(k, threads, flops / made.DISTURBANCE[k - 1]) for k in range(1, 7) for threads, flops in ((1, 1e9),
                                                                                                              (2, 1.6e9))]
    r = report([(made.point("naive_omp", 6, n), 1.0 / n) for n in (1, 2)], before=[made.environment(), *paces])
    two = only(r.speedup, threads=2)
    assert (two["machine_speedup"], two["of_machine"]) == pytest.approx((1.6, 2 / 1.6))
    assert two["machine_speedup_low"] == pytest.approx(1.6) and two["machine_rounds"] == 6


def test_points_of_different_rounds_are_compared_unpaired_and_said_to_be(report):
    early, late = ({"rounds": 3},), (lambda k: {"rounds": 9 if k > 3 else 0},)
    r = report([(made.point("naive"), 1.0, *early), (made.point("symmetric"), 0.5, *late)])
    e = only(r.algorithm_speedup)
    assert e["rounds"] == 0 and e["low"] < e["ratio"] < e["high"]
    assert any("were measured in different rounds: their ratio is not paired" in c for c in r.caveats)


def test_backends_are_compared_with_their_best_granularity(report):
    r = report([(made.point("naive_omp", 6, 2), 1.0), (made.point("symmetric_omp", 6, 2), 0.5),
                (made.point("symmetric_omp", 6, 2, granularity="dynamic:1"), 0.9)])
    assert only(r.algorithm_speedup)["ratio"] == pytest.approx(2)


def test_caveats_say_what_weakens_the_numbers(report):
    r = report([(made.point("naive_omp", 6, 4), 1.0, {"lost": 3, "threads_worked": 2})], rounds=5)
    for text in ("more threads than cores: naive_omp M=6 threads=4", "particles left Omega, and later steps summed the others alone: naive_omp M=6 threads=4 (6 of ",
                 "fewer threads worked in a step than were asked for: naive_omp M=6 threads=4 (10 of 10 steps)", "fewer than 6 rounds, so no interval of the median",
                 "no speedup over 1 thread, which was not measured: naive_omp M=6 threads=4"):
        assert any(c.startswith(text) for c in r.caveats), text
    assert np.isnan(r.points["sum_s_low"][0]) and r.points["sum_s"][0] == pytest.approx(1.0)
    assert np.isnan(r.points["ns_per_pair"][0]) and r.points["lost"][0] == 6, "3 in each of 2 steps"
    some = report([(made.point("naive_omp", 6, 4), 1.0, lambda k: {"threads_worked": 2 if k == 3 else 4}), (made.point("naive_omp", 6, 2), 1.0)])
    assert "fewer threads worked in a step than were asked for: naive_omp M=6 threads=4 (2 of 12 steps)" in some.caveats
    loose = report([(made.point("naive"), 1.0)], before=[made.environment(dirty=True, binding="none: EPERM")])
    assert loose.caveats[:2] == ["built from a tree with uncommitted changes", "threads were not pinned (none: EPERM)"]
    limits = {"none": 0, "4 GiB of memory": 0, "2.5 processors, 4 GiB of memory": 1}
    for text, said in limits.items():
        job = report([(made.point("naive"), 1.0)], before=[made.environment(limits=text)])
        assert sum(c.startswith(f"a control group limits the job to {text}") for c in job.caveats) == said


def strategies(dim=3, slow=1.0):
    """Strategies on 1 and 2 threads; locks cost 1.6 times the serial sweep and scale badly."""
    places = [("naive_omp", 1.0, 2.0), ("sphysics_sweep", 0.5, None), ("symmetric_omp", 0.5, 1.9), ("locks_omp", 0.8, 1.2),
              ("copies_omp", 0.55, 1.8)]
    found = []
    for name, time, scaling in places:
        for threads in (1, 2):
            if threads == 1 or scaling:
                memory = 500 + (2e8 if name == "copies_omp" else 0)
                factor = slow if name == "locks_omp" else 1
                found.append((made.point(name, 6, threads, dim=dim), factor * time / (scaling if threads == 2 else 1),
                              {"workspace_bytes": int(memory)}))
    return found


def test_a_ladder_has_every_strategy_at_its_best(report):
    r = report([*strategies(), (made.point("symmetric_omp", 7, 2), 0.9)])
    top = r.ladder[r.ladder["at"] == "most_threads"]
    assert top["backend"].to_list() == ["symmetric_omp", "copies_omp", "naive_omp", "sphysics_sweep", "locks_omp"]
    assert top["rank"].to_list() == [1, 2, 3, 4, 5] and set(top["base_backend"]) == {"naive_omp"}
    locks = only(top, backend="locks_omp")
    assert (locks["ratio"], locks["efficiency"]) == pytest.approx((0.5 / (0.8 / 1.2), 0.6)) and locks["verdict"] == "slower"
    assert locks["time_s"] == pytest.approx(1.5 * made.MEDIAN * 0.8 / 1.2)  # prepare, zero, sum and reduce
    one = only(r.ladder[r.ladder["at"] == "one_thread"], backend="locks_omp")
    assert one["over_serial"] == pytest.approx(1.6) and np.isnan(one["efficiency"])
    assert only(top, backend="copies_omp")["extra_bytes_per_particle"] == pytest.approx(200)
    said = r.strategies.set_index("backend")
    assert said.loc["locks_omp", ["conflicts", "runtime", "symmetric"]].to_list() == ["locks", "omp", True]
    assert said["breaks_down"]["locks_omp"] == ("1 thread: 1.60 [1.60, 1.60] times the serial sweep (dam_break 3D); "
                                                "2 threads: efficiency 0.60 [0.60, 0.60] (dam_break 3D)")
    assert said["breaks_down"]["copies_omp"].startswith("memory: 200 bytes a particle more than the leanest, on 1 thread")
    assert said["breaks_down"].isna()["symmetric_omp"]


def test_a_ladder_needs_a_base_and_two_more(report):
    assert report([p for p in strategies() if p[0]["backend"] != "naive_omp"]).ladder.empty
    assert report([p for p in strategies() if p[0]["backend"] in ("naive_omp", "locks_omp")]).ladder.empty


def test_a_strategy_that_fares_worse_in_another_world_is_named(report):
    r = report([*strategies(), *strategies(2, 1.5)])
    locks = only(r.shifts, backend="locks_omp")
    assert (locks["what"], locks["world"], locks["base_world"]) == ("dimension", "dam_break 2D", "dam_break 3D")
    assert locks["ratio"] == pytest.approx(1 / 1.5) and locks["verdict"] == "slower"
    assert only(r.shifts, backend="symmetric_omp")["verdict"] == "not resolved"
    assert "dam_break 2D: against naive_omp 1.50 [1.50, 1.50] times as slow as in dam_break 3D; rank 5 of 5 after 5 of 5" in \
        r.strategies.set_index("backend")["breaks_down"]["locks_omp"]


def test_the_answer_is_the_fastest_step_of_the_largest_problem(report):
    r = report([*made.talk(), (made.point("symmetric_omp", 7, 2), 0.251, made.scattered(.05, -.05, .03, -.03, .04, -.04)),
                (made.point("symmetric_omp", 6, 2, n_fluid=10), 1e-6)])
    best = r.points.loc[r.answer.point]
    assert (best["backend"], best["M"], best["threads"], best["n_fluid"]) == ("symmetric_omp", 6, 2, 1000000)
    assert [r.points["M"][k] for k in r.answer.ties] == [7] and r.answer.over_symmetric is None and r.answer.decided
    gather = r.answer.over_gather
    assert r.points.loc[gather["point"], ["backend", "threads"]].to_list() == ["naive_omp", 2]
    assert gather["ratio"] == pytest.approx(2) and gather["verdict"] == "faster"
    assert r.answer.text == ("On node symmetric_omp (M = 6, 2 threads) is the fastest of 6 backends, tied with "
                             "symmetric_omp (M = 7): 2.00 [2.00, 2.00] times as fast as naive_omp, on 1,000,000 fluid and "
                             "1,014,966 boundary particles.")
    assert "takes 525 ms" in r.answer.details and "the fastest gather" not in r.answer.details
    assert r.answer.command == ("pairsum run --case dam_break --dx 0.00594 --state rest --grid hashed_grid --threads 2 --M 6 "
                                "--backend symmetric_omp")


def test_the_fastest_is_behind_nobody_and_the_gather_on_vector_units_is_said(report):
    """By medians naive_omp would be the fastest; by geometric means, which ratios are made of, symmetric_omp is."""
    noisy = made.scattered(-.02, .5, -.02, .6, -.02, -.02)
    units = {"work": made.work(vector_units={"block": "none", "lanes": 4, "vectors": 9, "occupancy": 0.8})}
    r = report([(made.point("naive_omp"), 2.0), (made.point("naive_omp", isa="avx2"), 1.0, lambda k: noisy(k) | units),
                (made.point("symmetric_omp"), 1.01, made.scattered(.001, -.001, .001, -.001, .001, -.001))])
    assert r.points["total_s"].idxmin() != r.answer.point
    assert r.points.loc[r.answer.point, "backend"] == "symmetric_omp"
    assert r.standings["behind"].min() == 1 and r.standings["rank"][r.standings["behind"] == 1].to_list() == [1]
    assert "times as fast as naive_omp (avx2), the fastest gather" in r.answer.details


def test_a_point_that_lost_particles_is_not_the_answer(report):
    loses = {"lost": 7}
    r = report([(made.point("naive_omp"), 2.0), (made.point("symmetric_omp"), 1.0, loses), (made.point("tiles_omp"), 1.5)])
    assert r.points.loc[r.answer.point, "backend"] == "tiles_omp"
    assert report([(made.point("naive_omp"), 2.0, loses)]).answer is not None


@pytest.mark.parametrize("points, how, reason, command", [
    ([(made.point("naive_omp", 6, 2), 1.0), (made.point("tiles_omp", None, 2, grid="compact_grid", isa="avx2"), .5)],
     {"rounds": 3}, "3 rounds of tiles_omp (compact_grid, 2 threads) give no interval (6 are needed)",
     "--backend tiles_omp,naive_omp --rounds 12"),
    ([(made.point("naive_omp"), 1.0, made.scattered(.05, -.05, .03, -.03, .04, -.04)), (made.point("symmetric_omp"), .999)],
     {}, "no difference was resolved between symmetric_omp (M = 6, 1 thread) and the other",
     "--backend symmetric_omp,naive_omp --rounds 12"),
    ([(made.point("naive_omp"), 1.0)], {}, "only naive_omp (M = 6, 1 thread) was measured", "--backend all --rounds 12")])
def test_what_does_not_decide_is_no_answer(report, points, how, reason, command):
    r = report(points, **how)
    assert not r.answer.decided and r.answer.reason == reason and r.answer.command.endswith(command)
    assert r.answer.text == f"On node nothing is decided, because {reason}."
    assert f"Run this:  {r.answer.command}" in answers.said_of(r.answer)


def test_what_is_known_of_self_test_backends_is_held_against_the_numbers(report):
    noise = made.scattered(.01, -.01, .02, -.02, .015, -.015)
    corrupt = {"error": "rate 7 is off", "phases": None, "work": None}
    points = [(made.point("symmetric_omp"), 1.0), (made.point("again_symmetric_omp"), 1.0, noise),
              (made.point("slowed_20_symmetric_omp"), 1.3, noise), (made.point("corrupt_symmetric_omp"), 1.0, corrupt)]
    r = report(points)
    again, slowed, wrong = (only(r.self_test, backend=f"{name}_symmetric_omp") for name in ("again", "slowed_20", "corrupt"))
    assert again["holds"] and again["expected"] == 1 and again["confidence"] == pytest.approx(1 - 0.05 / 2)
    assert not slowed["holds"] and "1.2 expected: OUTSIDE the interval, told from its base" in slowed["text"]
    assert wrong["holds"] and wrong["text"] == "refused, as it must be: rate 7 is off"
    assert any(c.startswith("self-test slowed_20_symmetric_omp M=6 threads=1 does not hold") for c in r.caveats)
    assert r.points.loc[r.answer.point, "backend"] == "symmetric_omp"  # a copy is no answer
    timed = report([*points[:1], (made.point("corrupt_symmetric_omp"), 1.0)])
    assert only(timed.self_test)["text"] == "it got a time, although it is wrong"


def test_a_backend_that_no_build_here_knows_is_reported_with_what_it_says(report):
    r = report([*strategies(), (made.point("martian_omp", 6, 2), 0.2)])
    martian = r.strategies.set_index("backend").loc["martian_omp"]
    assert martian[["conflicts", "runtime", "description"]].to_list() == ["other", "omp", "martian_omp in one line"]
    assert only(r.ladder[r.ladder["at"] == "most_threads"], backend="martian_omp")["rank"] == 1


@pytest.mark.parametrize("points, lines", [
    ([(made.point("naive"), 1.0, {"error": "off", "phases": None, "work": None})], 0),
    ([(made.point("again_naive"), 1.0)], 1), ([(made.point("naive_omp", 6, n), 0.0) for n in (1, 2)], 2),
    ([(made.point("naive"), 1.0, {"phases": dict.fromkeys(pr.PHASES), "work": None})], 1)])
def test_what_cannot_be_compared_is_reported_without_comparisons(report, points, lines, tmp_path):
    r = report(points)
    assert r.answer is None and not r.questions and len(r.points) == lines
    assert all(table.empty for name, table in r.tables.items() if name not in ("points", "m_comparison", "self_test"))
    summary.write(r, tmp_path)


def test_threads_are_busy_or_wait(report):
    passes = {"threads_busy_s": [[0.1, 0.2], [0.1, 0.0]], "barrier_wait_s": [[0.1, 0.0], [0.0, 0.1]]}
    r = report([(made.point("symmetric_omp", 6, 2), 1.0, passes), (made.point("naive"), 1.0)])
    times = pr.thread_times(r.results)
    assert times[["thread", "busy_s", "waiting_s"]].to_numpy().ravel() == pytest.approx([0, 0.2, 0.1, 1, 0.2, 0.1])
    assert only(r.points, backend="symmetric_omp")["wait_share"] == pytest.approx(1 / 3)
