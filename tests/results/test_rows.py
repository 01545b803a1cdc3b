"""Reading rows: both schemas, what counts, and every bad file in one line that names it."""
import json

import made
import numpy as np
import pandas as pd
import pytest
from conftest import ROOT

import pairsum_results as pr
from pairsum_results import rows, summary
from pairsum_results.sides import compare_sides


def changed(kind, /, **change):
    """The small study with the first row of a kind changed; a value of ... takes the key away."""
    def change_of(row):
        for key, value in change.items():
            *path, last = key.split("__")
            inner = row
            for name in path:
                inner = inner[name]
            if value is ...:
                del inner[last]
            else:
                inner[last] = value

    found = json.loads(json.dumps(made.study([(made.point("naive"), 1.0)], 2, [made.environment(), made.peak(1, 1.0, 1.0)])))
    change_of(next(row for row in found if row["kind"] == kind))
    return found


WRONG = [
    (changed("sample", round=0), '4: key "round" should be an integer >= 1, is the number 0'),
    (changed("sample", part=7), '4: key "part" should be a string without control characters, is the number 7'),
    (changed("sample", part="a\x1b[31m"), 'key "part" should be a string without control characters, is "a\\u001b[31m"'),
    (changed("environment", host="\ud800"), 'key "host" should be a string without control characters, is "\\ud800"'),
    (changed("sample", point__dx="x"), '4: key "point.dx" should be a number, is "x"'),
    (changed("sample", point__M=0), '4: key "point.M" should be an integer >= 1 or null, is the number 0'),
    (changed("sample", phases__sum_s=-1), '4: key "phases.sum_s" should be a number >= 0 or null, is the number -1'),
    (changed("sample", phases=5), '4: key "phases" should be an object, is the number 5'),
    (changed("sample", point=None), '4: key "point" should be an object, is null'),
    (changed("sample", threads_busy_s=[[-1]]), 'key "threads_busy_s" should be an array of arrays of numbers >= 0 or null'),
    (changed("sample", work__flops=...), '4: key "work.flops" is missing'),
    (changed("sample", lost=...), '4: key "lost" is missing'),
    (changed("sample", colour="red"), '4: key "colour" is not known in this kind of row'),
    (changed("sample", verify__fingerprint="xyz"), '"verify.fingerprint" should be 16 hex digits or null, is "xyz"'),
    (changed("sample", utc="today"), '4: key "utc" should be a UTC time like 2026-11-22T15:30:00.123Z, is "today"'),
    (changed("sample", error="bad"), '4: key "phases" should be null in a row with "error", is an object'),
    (changed("sample", phases=None), '4: key "phases" should be an object in a row without "error", is null'),
    (changed("sample", environment="0" * 16), 'key "environment" should name an environment row before it'),
    (changed("sample", point__backend="other"), 'key "point.backend" should name a backend row of its environment'),
    (changed("sample", kind="simple"), '4: key "kind" should be "sample" or "environment"'),
    (changed("sample", schema="pairsum.row/9"), '4: key "schema" should be "pairsum.row/3" or "pairsum.row/2"'),
    (changed("round", rows=3), '6: key "rows" should be the number of samples of the round, 2, is 3'),
    (changed("round") + [made.sample(made.point("naive"), 1.0, 2)], '10: key "round" names round 2, which a round row before it has closed'),
    (changed("peak", flops_per_s=0), '2: key "flops_per_s" should be a number > 0, is the number 0'),
    (changed("backend", symmetric="yes"), '3: key "symmetric" should be true or false, is "yes"'),
    (changed("backend", schema="pairsum.row/2"), '3: key "schema" should be "pairsum.row/3", is "pairsum.row/2"'),
    (changed("environment", cores=True), '1: key "cores" should be an integer >= 1, is a boolean'),
]


@pytest.mark.parametrize("content, says", WRONG, ids=[says[:60] for _, says in WRONG])
def test_a_wrong_row_is_refused_with_its_line(tmp_path, content, says):
    path = made.write(tmp_path / "rows.jsonl", content)
    with pytest.raises(pr.ResultsError) as caught:
        pr.load([path])
    assert says in str(caught.value) and str(caught.value).startswith(f"{path}:") and "\n" not in str(caught.value)


@pytest.mark.parametrize("text, says", [
    ("", "is empty, should hold rows of pairsum.row/3"),
    ("hello\n", ":1: this is no rows file"),
    ('{"a": 1}\n', ":1: this is no rows file"),
    (json.dumps(made.environment()), ":1: the last line is cut; remove it to keep the 0 whole rows before it"),
    (json.dumps(made.environment()) + '\n{"schema": "pair', ":2: the last line is cut; remove it to keep the 1 whole row"),
    (json.dumps(made.environment()) + "\n{\n{}\n", ":2: it is no whole JSON value"),
    (json.dumps(made.environment()).replace('"cores": 2', '"cores": NaN') + "\n{}\n", ":1: "),
    (json.dumps(made.environment()) + "\n[]\n", ":2: a row should be an object, is an array"),
    (json.dumps(made.environment()) + "\n", "there is no finished round in the rows"),
])
def test_a_wrong_file_is_refused(tmp_path, text, says):
    path = tmp_path / "rows.jsonl"
    path.write_text(text)
    with pytest.raises(pr.ResultsError, match="^[^\n]*$") as caught:
        pr.load([path])
    assert says in str(caught.value)


@pytest.mark.parametrize("before, after, key", [
    ('"part": "all"', '"part": "all", "part": "all"', "part"),
    ('"part":', '"part" : "all", "part":', "part"),
    ('"part":', '"part":":\\"", "part":', "part"),
    ('"total_s":', '"sum_s":1,"total_s":', "sum_s"),
    ('"point": {', '"po\\u0069nt": {}, "point": {', "point"),
])
@pytest.mark.parametrize("separators", [None, (",", ":")], ids=["spaced", "compact"])
def test_a_key_that_is_there_twice_is_refused(tmp_path, before, after, key, separators):
    lines = [json.dumps(row) for row in changed("round")]
    lines[3] = lines[3].replace(before, after, 1)
    assert lines != [json.dumps(row) for row in changed("round")]
    path = tmp_path / "rows.jsonl"
    path.write_text("\n".join(lines if separators is None else [line.replace(", ", ",").replace(": ", ":") for line in lines]) + "\n")
    with pytest.raises(pr.ResultsError) as caught:
        pr.load([path])
    assert str(caught.value) == f'{path}:4: key "{key}" is there twice in its object'


def test_colons_and_quotes_in_texts_are_no_keys(tmp_path):
    path = made.write(tmp_path / "rows.jsonl", changed("environment", flags='":"a" :":', host=':'))
    assert pr.load([path]).points is not None


def test_files_of_other_editors(tmp_path):
    path = made.write(tmp_path / "rows.jsonl", made.study(made.talk()))
    text, wanted = path.read_text(), pr.load([path]).points
    path.write_bytes(b"\xef\xbb\xbf" + text.replace("\n", "\r\n").encode())
    assert pr.load([path]).points.equals(wanted)
    for encoding in ("utf-16", "utf-16-le", "utf-16-be"):
        path.write_text(text, encoding)
        with pytest.raises(pr.ResultsError, match="rows.jsonl: is UTF-16, should be UTF-8$"):
            pr.load([path])


def test_a_line_without_an_end_is_not_read_to_it(tmp_path):
    for begin in ("", json.dumps(made.environment()) + "\n"):
        path = tmp_path / "rows.jsonl"
        path.write_text(begin)
        with path.open("r+") as file:
            file.truncate(1 << 31)
        with pytest.raises(pr.ResultsError, match=f":{1 + len(begin.splitlines())}: the line has more than 16 MB"):
            pr.load([path])


def test_files_that_are_none(tmp_path):
    for given, says in (([], "at least one rows file"), ([tmp_path], "has no rows files"),
                        ([tmp_path / "none.jsonl"], "No such file"), (["/dev/null"], "is no regular file")):
        with pytest.raises(pr.ResultsError, match=says):
            pr.load(given)


def test_rows_of_both_schemas_give_the_same_times_and_null_for_what_is_not_said(tmp_path):
    new = made.study(made.talk())
    old = [row for row in map(made.former, new) if row]
    one, other = (pr.load([made.write(tmp_path / name / "rows.jsonl", content)])
                  for name, content in (("new", new), ("old", old)))
    assert one.points[pr.TIMES].equals(other.points[pr.TIMES])
    assert one.points["flops"].eq(1e9).all() and other.points[["flops", "lost", "workspace_bytes"]].isna().all(axis=None)
    assert one.backends.loc["naive_omp", "runtime"] == "omp" and other.backends["runtime"].isna().all()
    assert (other.points["block"] == "none").all()
    assert len(pr.report(one).ladder) == len(pr.report(other).ladder) > 0


def test_the_reader_knows_the_keys_of_the_row_schema():
    known = json.loads((ROOT / "harness/rows/row.schema.json").read_text())["definitions"]
    for kind, spec in rows._KINDS.items():
        keys = {key.rstrip("?") for key in spec} | {"schema", "kind", "study", "utc"}
        assert keys == set(known[kind]["properties"]), kind
    assert set(rows._POINT) == set(known["point"]["properties"]) and set(rows._WORK) == set(known["work"]["properties"])


@pytest.mark.parametrize("place", ["lost", "threads_worked", "work__flops", "work__bytes"])
def test_rows_of_schema_2_have_nothing_of_schema_3(tmp_path, place):
    content = [row for row in map(made.former, changed("sample")) if row]
    *path, key = place.split("__")
    inner = next(row for row in content if row["kind"] == "sample")
    for name in path:
        inner = inner[name]
    inner[key] = 1
    with pytest.raises(pr.ResultsError, match=rf':3: key "{place.replace("__", ".")}" is not known in this kind of row$'):
        pr.load([made.write(tmp_path / "rows.jsonl", content)])


def test_one_path_is_taken_as_a_path(tmp_path):
    path = made.write(tmp_path / "rows.jsonl", changed("sample"))
    assert len(pr.load(str(path)).points) == len(pr.load(path).points) == len(pr.load(tmp_path).points) == 1


def test_folders_are_read_with_those_below_and_without_empty_files(tmp_path):
    made.write(tmp_path / "talk/rows.jsonl", changed("sample"))
    (tmp_path / "talk/killed.jsonl").write_text("")
    assert pr.load(tmp_path).sources == ["talk/rows.jsonl"]
    with pytest.raises(pr.ResultsError, match="killed.jsonl: is empty"):
        pr.load(tmp_path / "talk/killed.jsonl")


def test_a_copy_of_a_rows_file_gives_no_new_rounds(tmp_path):
    first, content = made.write(tmp_path / "rows.jsonl", changed("sample")), changed("sample")
    copy = made.write(tmp_path / "copy.jsonl", content)
    alone, both = pr.load(first), pr.load([first, copy])
    pd.testing.assert_frame_equal(alone.points, both.points)
    name = tmp_path.name
    assert both.caveats == [*alone.caveats, f"{name}/copy.jsonl holds 2 rounds of {name}/rows.jsonl, too: taken once"]
    pd.testing.assert_frame_equal(alone.rounds, pr.load([copy, first]).rounds)
    made.write(copy, [{**row, "utc": "2026-11-23T15:30:00Z"} for row in content])  # measured the next day
    assert pr.load([first, copy]).points["rounds"].to_list() == [4]


def test_of_partly_equal_files_each_round_counts_once(tmp_path):
    """A study was copied after its fourth round, and both went on."""
    def gone_on(until, utc):
        rows = made.study([(made.point("naive"), 1.0), (made.point("symmetric"), 0.5)], 6)
        return [row if row.get("round", 1) <= until else {**row, "utc": utc} for row in rows]
    first = made.write(tmp_path / "a.jsonl", gone_on(6, ""))
    other = made.write(tmp_path / "b.jsonl", gone_on(4, "2026-11-23T15:30:00Z"))
    both = pr.load([first, other])
    assert both.points["rounds"].to_list() == [8, 8] and "b.jsonl holds 4 rounds of" in both.caveats[-1]


def test_a_round_that_is_void_in_a_copy_does_not_count(tmp_path):
    content = made.study([(made.point("naive"), 1.0)], 6)
    void = {**{key: content[-1][key] for key in ("schema", "study", "utc")}, "kind": "void", "round": 2, "reason": "x"}
    files = [made.write(tmp_path / "a.jsonl", content), made.write(tmp_path / "b.jsonl", [*content, void])]
    assert pr.load(files).points["rounds"].to_list() == [5] == pr.load(files[::-1]).points["rounds"].to_list()


def test_a_copy_that_was_changed_is_refused(tmp_path):
    content = made.study([(made.point("naive"), 1.0)], 6)
    first = made.write(tmp_path / "a.jsonl", content)
    changed_row = next(row for row in content if row["kind"] == "sample" and row["round"] == 3)
    changed_row["phases"]["sum_s"] /= 2
    with pytest.raises(pr.ResultsError, match="hold round 3 of talk with different values: one of them was changed"):
        pr.load([first, made.write(tmp_path / "b.jsonl", content)])


def test_a_file_is_not_compared_with_its_copy(tmp_path):
    content = made.study([(made.point("naive"), 1.0)], 6)
    files = [str(made.write(tmp_path / name, content)) for name in ("a.jsonl", "b.jsonl")]
    with pytest.raises(pr.ResultsError, match="hold the same rounds: nothing can be compared"):
        compare_sides(*files, [])


def test_integers_stay_integers_beside_a_file_without_such_rows(tmp_path):
    made.write(tmp_path / "a.jsonl", changed("sample"))
    later = [{**row, "utc": "2026-11-23T15:30:00Z"} for row in made.study([(made.point("naive"), 1.0)], 2)]
    made.write(tmp_path / "b.jsonl", later)
    found = summary.summary(pr.report(pr.load(tmp_path)))
    assert [type(peak["threads"]) for peak in found["peaks"]] == [int]


def test_void_unfinished_and_unverified_rounds_do_not_count(tmp_path):
    content = made.study([(made.point("naive"), 1.0), (made.point("symmetric"), 0.5)])
    bad = next(row for row in content if row["kind"] == "sample" and row["round"] == 3)  # of naive: its round is out
    bad["verify"]["fingerprint"] = None
    content += [made.sample(made.point("naive"), 1000.0, 7), made.closing(7, 1),
                made.head("void", round=7, reason="cut"), made.sample(made.point("naive"), 1000.0, 8)]
    wrong = made.sample(made.point("naive", 9), 1.0, 9, error="particle 7 is off", phases=None)
    content += [wrong, made.closing(9, 1)]
    found = pr.load([made.write(tmp_path / "rows.jsonl", content)])
    naive = found.points[found.points["backend"] == "naive"].iloc[0]
    assert (naive["rounds"], len(found.points), found.void_rounds, len(found.closed)) == (5, 2, 1, 7)
    assert naive["sum_s"] == pytest.approx(np.median([1.0, 1.2, 1.4, 0.9, 1.1]))
    assert set(found.failed["error"]) == {"not verified", "particle 7 is off"}
    assert "naive M=9 threads=1: 1 row without a passed verification left out" in pr.report(found).caveats


def test_rows_of_different_builds_are_refused_unless_they_are_what_is_compared(tmp_path):
    other = made.environment("1" * 16, compiler="Clang 14.0.6")
    naive = made.point("naive")
    made.write(tmp_path / "apart/a.jsonl", made.study([(naive, 1.0)]))
    made.write(tmp_path / "apart/b.jsonl", made.study([(naive, 0.8, {"environment": "1" * 16})], before=[
        other, made.environment()]))
    with pytest.raises(pr.ResultsError, match=r"different machines or builds: compiler \(Clang 14.0.6, GNU 12.2.0\);"):
        pr.load([tmp_path / "apart"])
    mixed = pr.load([tmp_path / "apart"], allow_mixed=True)
    assert len(mixed.series) == 2 and pr.compiler_comparison(mixed).empty
    together = pr.load([made.write(tmp_path / "both.jsonl", made.study(
        [(naive, 1.0), (naive, 0.8, {"environment": "1" * 16})], before=[made.environment(), other]))])
    builds = pr.compiler_comparison(together).iloc[0]
    assert builds["ratio"] == pytest.approx(1.25) and builds["verdict"] == "faster"
    assert (builds["build"], builds["base_build"]) == ("Clang 14.0.6, git abc1234", "GNU 12.2.0, git abc1234")
    assert any(c.startswith("the builds differ, which is what is compared: compiler") for c in together.caveats)


def test_points_are_told_apart_by_what_they_are(tmp_path):
    units = {"work": made.work(vector_units={"block": "none", "lanes": 8, "vectors": 10, "occupancy": 0.5})}
    content = made.study([(made.point("tiles_omp", None, 2, grid="compact_grid", isa="avx512"), 1.0, units),
                          (made.point("naive", isa="native"), 1.0), (made.point("naive", state="perturbed"), 1.0)])
    found = pr.load([made.write(tmp_path / "rows.jsonl", content)])
    isas = dict(zip(found.points["backend"], found.points["isa"]))
    assert isas == {"tiles_omp": "avx512", "naive": "scalar"}  # rows used to name that of the build
    assert np.isnan(found.points.set_index("backend")["M"]["tiles_omp"])
    assert found.series["seed"].isna().to_list() == [True, False]  # particles at rest do not depend on it
