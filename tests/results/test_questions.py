"""The talk's questions: verdict, number and details of rows with known effects."""
import artists
import made
import pytest

PEAKS = [made.environment(), made.peak(1, 1e10, 1e9), made.peak(2, 2e10, 2e9)]
TWICE, SCALES, M, RUNTIME, BOUND = (
    "Is the symmetric sum twice as fast as the gather?", "Does it scale as well, within 5 %?",
    "Is M = 7 best for the gather, M = 6 for the symmetric sum?", "Is oneTBB faster than OpenMP?",
    "Does a sum reach half of what the machine can do?")
NOISE = made.scattered(.2, -.2, .3, -.3, .25, -.25)


@pytest.fixture
def asked(tmp_path):
    """The questions of rows by their text."""
    return lambda points, rounds=6: {q["question"]: q for q in artists.report(
        tmp_path, made.study(points, rounds, PEAKS)).questions}


def test_details_are_what_was_measured(asked):
    found = asked(made.talk())
    assert list(found) == [TWICE, SCALES, M, RUNTIME, BOUND]
    said = {question: q["answer"] for question, q in found.items()}
    assert said[TWICE].startswith("On 2 threads: OpenMP naive M = 6 over symmetric M = 6: 2.00 [2.00, 2.00], oneTBB")
    assert said[SCALES].startswith("On 2 threads gathers are 2.00 times as fast as on one, symmetric sums 2.00")
    assert "symmetric M = 6 (1050.0 ms a step; M = 7 takes 1.20 times as long)" in said[M]
    assert said[RUNTIME].startswith("Of 4 comparisons oneTBB is faster in 0, OpenMP in 4")
    # 1e9 flops at 1e10 per s on 1 thread, 1e8 bytes at 1e9 per s: 100 ms, of symmetric's 525 ms.
    assert "symmetric with M = 6 and 1 thread: its arithmetic could not be done in less than 100.00 ms, and that is " \
        "19.0" in said[BOUND]
    assert list(asked([(made.point("naive"), 1.0)])) == [BOUND]


def pairs(symmetric, gain=2.0, change=None):
    """A gather and a symmetric sum on 1 and 2 threads."""
    return [(made.point("naive_omp", 6, 1), 1.0), (made.point("naive_omp", 6, 2), 0.5),
            (made.point("symmetric_omp", 6, 1), symmetric, change or {}),
            (made.point("symmetric_omp", 6, 2), symmetric / gain)]


@pytest.mark.parametrize("symmetric, change, rounds, verdict, number", [
    (0.4, None, 6, "Yes", "2.50 [2.50, 2.50] times (symmetric_omp over naive_omp)"),
    (0.6, None, 6, "No", "1.67 [1.67, 1.67] times"), (0.4, None, 2, "Not decided", "2.50 (no interval) times"),
    (0.5, NOISE, 6, "Not decided", "2.00 [")])
def test_twice_is_decided_by_the_interval(asked, symmetric, change, rounds, verdict, number):
    points = [(place, time, change or {}) if place["backend"] == "symmetric_omp" else (place, time)
              for place, time, *_ in pairs(symmetric)]
    found = asked(points, rounds)[TWICE]
    assert found["verdict"] == verdict and found["number"].startswith(number)


def test_the_talks_sum_is_the_one_without_vector_units(asked):
    units = {"work": made.work(vector_units={"block": "none", "lanes": 8, "vectors": 9, "occupancy": 0.8})}
    vector = [(made.point(name, 6, 2, isa="avx512"), time, units) for name, time in (("naive_omp", 0.1),
                                                                                   ("symmetric_omp", 0.15))]
    assert asked([*pairs(0.4), *vector])[TWICE]["number"].startswith("2.50")
    assert asked(vector)[TWICE]["number"].startswith("0.67")


@pytest.mark.parametrize("gain, change, verdict, number", [
    (1.5, None, "No", "0.75 [0.75, 0.75] of the speedup of naive_omp (symmetric_omp)"), (1.98, None, "Yes", "0.99 ["),
    (2.0, NOISE, "Not decided", "1.00 [0.")])
def test_scaling_as_well_has_a_margin(asked, gain, change, verdict, number):
    found = asked(pairs(0.7, gain, change))[SCALES]
    assert found["verdict"] == verdict and found["number"].startswith(number)


@pytest.mark.parametrize("times, verdict, number", [
    ((1.0, 0.9, 0.5, 0.6), "Yes", "naive_omp: M = 6 takes 1.11 [1.11, 1.11] times M = 7"),
    ((1.0, 0.9, 0.6, 0.5), "No", "symmetric_omp: M = 6 takes 1.20 [1.20, 1.20] times M = 7"),
    ((0.9, 1.0, 0.5, 0.6), "No", "naive_omp: M = 7 takes 1.11")])
def test_the_talks_m_are_held_against_the_best(asked, times, verdict, number):
    places = [made.point(name, m, 2) for name in ("naive_omp", "symmetric_omp") for m in (6, 7)]
    found = asked(list(zip(places, times)))[M]
    assert found["verdict"] == verdict and found["number"].startswith(number)
    found = asked([(place, time, NOISE if place["M"] == 7 else {}) for place, time in zip(places, times)])[M]
    assert found["verdict"] == "Not decided"
    found = asked([(made.point("naive_omp", m, 2), 1 / m) for m in (5, 8)])[M]
    assert (found["verdict"], found["number"]) == ("Not decided", "naive_omp: M = 7 was not measured")


@pytest.mark.parametrize("tbb, change, verdict", [(0.8, None, "Yes"), (1.2, None, "No"), (1.01, NOISE, "Not decided")])
def test_a_runtime_is_faster_if_that_is_resolved(asked, tbb, change, verdict):
    found = asked([(made.point("naive_omp", 6, 2), 1.0), (made.point("naive_tbb", 6, 2), tbb, change or {})])[RUNTIME]
    assert found["verdict"] == verdict and found["number"].endswith("times (naive)")


@pytest.mark.parametrize("time, rounds, verdict", [(0.12, 6, "Yes"), (0.5, 6, "No"), (0.2, 6, "Not decided"),
                                                   (0.12, 5, "Not decided")])
def test_the_bound_is_near_from_half_on(asked, time, rounds, verdict):
    found = asked([(made.point("naive", 6, 1), 1.0), (made.point("symmetric", 6, 1), time)], rounds)[BOUND]
    assert found["verdict"] == verdict and found["number"].endswith("% (symmetric)")
