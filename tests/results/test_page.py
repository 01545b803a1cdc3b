"""The page in a browser: wide and narrow, light and dark, printed; and what it must not let in."""
import builtins
import importlib
import re
import sys

import artists
import browser
import made
import pytest
from selenium.webdriver.common.by import By

import pairsum_results as pr
from pairsum_results import figures, page

WIDTHS = (1280, 390)
EVIL = '<script>window.taken = 1</script><img src=x onerror="window.taken = 2">"\'{{ 7 * 7 }}</title>'
#: What would load something from elsewhere.
OUTSIDE = re.compile(r"""(?:\s(?:src|srcset|href|xlink:href|poster|data|action)=["']?|url\(\s*["']?|@import\s+["']?)"""
                     r"""(?!\#|data:)[^"'\s)>]|<script[^>]*>[^<]*https?://""")


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    return artists.report(tmp_path_factory.mktemp("rows"), artists.everything())


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    """The report of another machine, with one series."""
    rows = made.study(made.talk(), before=[made.environment(host="bignode", cpu="Another CPU 7702")])
    return artists.report(tmp_path_factory.mktemp("other"), rows)


@pytest.fixture(scope="module")
def one(report, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "report.html"
    page.write([report], path)
    return path


@pytest.fixture(scope="module")
def both(report, other, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "both.html"
    page.write([report, other], path)
    return path


@pytest.fixture(scope="module")
def chromium():
    driver = browser.start()
    yield driver
    driver.quit()


@pytest.mark.parametrize("width", WIDTHS)
def test_the_page_is_quiet_loads_nothing_and_fits(chromium, one, both, width):
    for path in (one, both):
        browser.show(chromium, path, width)
        assert browser.console(chromium) == [] and browser.requests(chromium, path) == []
        browser.open_all(chromium)
        wide, inner = chromium.execute_script("return [document.documentElement.scrollWidth, innerWidth]")
        assert inner == width and wide <= width
        assert not OUTSIDE.search(path.read_text()) and path.stat().st_size < 3e6


@pytest.mark.parametrize("planted", [
    '<img src="https://example.org/a.png">', '<img srcset="//example.org/a.png 2x">', '<use href="other.svg#a"/>',
    '<link rel="stylesheet" href="a.css">', "<style>@import 'a.css';</style>", '<p style="background:url(a.png)">',
    '<form action="https://example.org">', "<script>fetch('https://example.org/')</script>"])
def test_what_would_be_loaded_is_found(planted):
    assert OUTSIDE.search(planted)


@pytest.mark.parametrize("width", WIDTHS)
def test_every_figure_is_there_and_can_be_read(chromium, one, width):
    browser.show(chromium, one, width)
    browser.open_all(chromium)
    heads = chromium.find_elements(By.CSS_SELECTOR, "h3[id^=figure]")
    assert [head.text for head in heads] == [drawing.heading for drawing in figures.ALL]
    drawn = chromium.execute_script("""return [...document.querySelectorAll("svg.figure")].map((svg) => {
      const box = svg.getBoundingClientRect(), room = svg.parentElement;
      return [box.width, box.height, svg.querySelectorAll("text").length, svg.getAttribute("aria-label"),
              room.clientWidth, getComputedStyle(room).overflowX]; })""")
    assert len(drawn) > len(figures.ALL) and len({label for *_, label, _, _ in drawn}) == len(drawn)
    for wide, high, texts, label, room, overflow in drawn:
        assert wide > 250 and high > 80 and texts > 3 and len(label) > 40
        assert wide <= room + 1 or overflow == "auto"
    ids = chromium.execute_script("return [...document.querySelectorAll('[id]')].map((node) => node.id)")
    assert len(ids) == len(set(ids))


def test_the_answer_stands_first(chromium, report, one, other, both):
    browser.show(chromium, both)
    answer = chromium.find_element(By.ID, "answer").text
    assert answer.startswith(report.answer.text) and other.answer.text in answer
    assert report.answer.command in answer
    heads = chromium.execute_script("return [...document.querySelectorAll('h2')].map((head) => head.innerText)")
    assert heads == ["Questions", "Figures", "Strategies", "Tables", "Environments", "Caveats"]


def test_machines_stand_beside_each_other_and_below_each_other_on_a_phone(chromium, both):
    places = ("return [...document.querySelector('#figure-ladder ~ .machines').children]"
              ".map((one) => [one.getBoundingClientRect().left, one.querySelectorAll('svg').length])")
    browser.show(chromium, both, 1280)
    (left, some), (right, others) = chromium.execute_script(places)
    assert right > left + 300 and (some, others) == (3, 1)
    browser.show(chromium, both, 390)
    (left, _), (right, _) = chromium.execute_script(places)
    assert right == left and "bignode" in chromium.find_element(By.ID, "environments").text


@pytest.mark.parametrize("width", WIDTHS)
def test_the_contents_lead_everywhere_and_open_what_they_lead_to(chromium, one, width):
    browser.show(chromium, one, width)
    contents = chromium.find_element(By.CSS_SELECTOR, "#contents details")
    assert (contents.get_attribute("open") is not None) == (width > 1000)
    if width < 1000:
        contents.find_element(By.TAG_NAME, "summary").click()
    links = contents.find_elements(By.TAG_NAME, "a")
    assert len(links) > 25 and all(link.is_displayed() for link in links)
    assert chromium.execute_script("return [...document.querySelectorAll('#contents a')]"
                                   ".every((link) => document.querySelector(link.getAttribute('href')))")
    table = next(link for link in links if link.text == "Algorithm speedup" and "#table" in link.get_attribute("href"))
    identity = table.get_attribute("href").split("#")[1]
    table.click()
    shown, top = chromium.execute_script(
        """const head = document.getElementById(arguments[0]);
        return [[...head.nextElementSibling.querySelectorAll("details")].map((one) => one.open),
                head.getBoundingClientRect().top];""", identity)
    assert shown[0] and not any(shown[1:]) and 0 <= top < 900
    assert (contents.get_attribute("open") is not None) == (width > 1000)


def test_tables_sort_by_number_and_by_word(chromium, one, report):
    browser.show(chromium, one)
    browser.open_all(chromium)
    table = chromium.find_element(By.XPATH, "//h3[text()='Summation time per step']/following-sibling::div//table")
    def natural(text):
        return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", text)]

    for head, kind in (("sum ms", float), ("backend", natural)):
        at = [h.text for h in table.find_elements(By.CSS_SELECTOR, "thead th")].index(head)
        for order in (1, -1):
            table.find_elements(By.CSS_SELECTOR, "thead button")[at].click()
            cells = [kind(row.find_elements(By.TAG_NAME, "td")[at].text)
                     for row in table.find_elements(By.CSS_SELECTOR, "tbody tr")]
            assert cells == sorted(cells)[::order] and len(cells) == (report.points["series"] == 0).sum()


@pytest.mark.parametrize("width", WIDTHS)
def test_light_and_dark_both_can_be_read(chromium, one, width):
    seen = {}
    for scheme in ("light", "dark"):
        browser.show(chromium, one, width, scheme)
        browser.open_all(chromium)
        seen[scheme] = browser.contrasts(chromium, "h1, h2, h3, p, td, button, dt, dd, li, a, summary, svg.figure text")
        assert [item for item in seen[scheme] if item[3] < 4.5] == []
    for light, dark in zip(seen["light"], seen["dark"]):
        assert light[0] == dark[0] and light[1] != dark[1] and light[2] != dark[2]


def test_low_contrast_is_found(chromium, tmp_path):
    (tmp_path / "pale.html").write_text('<p style="color:#999;background:#fff">pale</p>')
    browser.show(chromium, tmp_path / "pale.html")
    (_, _, _, contrast), = browser.contrasts(chromium, "p")
    assert 2.8 < contrast < 2.9


def test_print_is_light_whole_and_without_contents(chromium, one):
    browser.show(chromium, one, 720, "dark", media="print")
    chromium.execute_script("dispatchEvent(new Event('beforeprint'))")
    assert not chromium.find_element(By.ID, "contents").is_displayed()
    assert browser.contrasts(chromium, "h1")[0][1:3] == ("29,33,37,255", "255,255,255,255")
    assert chromium.execute_script("""return [...document.querySelectorAll("main details")].every((one) => one.open)
      && [...document.querySelectorAll(".table")].every((one) => one.scrollHeight <= one.clientHeight + 1)
      && [...document.querySelectorAll("svg.figure")].every((svg) => svg.getBoundingClientRect().height < 870)""")


def test_text_of_rows_cannot_become_markup(chromium, one, tmp_path):
    points = [(made.point(name, 6, n, case=EVIL, granularity=EVIL, dx=dx), 1.0)
              for name in ("naive_omp", EVIL) for n in (1, 2) for dx in (0.1, 0.2)]
    rows = made.study(points, before=[made.environment(host=EVIL, cpu=EVIL, libraries={EVIL: EVIL}, flags=EVIL)])
    path = tmp_path / "report.html"
    page.write([artists.report(tmp_path, rows)], path)
    html = path.read_text()
    assert html.count("<script") == 1 and "<img" not in html and "&lt;script&gt;" in html
    browser.show(chromium, path)
    assert chromium.execute_script("return window.taken === undefined") and browser.console(chromium) == []
    (tmp_path / "planted.html").write_text(one.read_text().replace("<main>", "<main><script>window.taken = 1</script>"))
    browser.show(chromium, tmp_path / "planted.html")
    assert chromium.execute_script("return window.taken === undefined")
    assert any("Content Security Policy" in line for line in browser.console(chromium))


def test_a_study_of_copies_alone_recommends_nothing_and_has_no_strategies(chromium, tmp_path):
    wrong = {"phases": None, "error": "it was wrong"}
    rows = made.study([(made.point("again_naive_omp"), 1.0), (made.point("symmetric_omp"), 1.0, wrong)])
    path = tmp_path / "report.html"
    page.write([artists.report(tmp_path, rows)], path)
    browser.show(chromium, path)
    text = chromium.find_element(By.TAG_NAME, "body").text
    assert "nothing can be recommended" in text and "No question was answered" in text and "it was wrong" in text
    assert "Not drawn: " in text and "Roofline (needs" in text and "nan" not in text and "None" not in text
    assert not chromium.find_elements(By.ID, "strategies")


def test_a_page_is_repeatable_and_written_whole(other, tmp_path):
    assert page.text([other]) == page.text([other])
    (tmp_path / "file").write_text("")
    with pytest.raises(pr.ResultsError, match="cannot write .*file"):
        page.write([other], tmp_path / "file" / "report.html")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@pytest.mark.parametrize("library, module", [("jinja2", "page"), ("matplotlib", "figures")])
def test_a_missing_library_is_one_line(monkeypatch, library, module):
    real = builtins.__import__
    monkeypatch.setattr(builtins, "__import__", lambda name, *rest: real(
        f"no_{name}" if name.split(".")[0] == library else name, *rest))
    monkeypatch.delitem(sys.modules, library, raising=False)
    with pytest.raises(pr.ResultsError, match=f"{library} for .*python3-{library}"):
        importlib.reload(sys.modules[f"pairsum_results.{module}"])
