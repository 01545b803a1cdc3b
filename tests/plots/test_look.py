"""What holds of every figure: one colour per backend, no text on another, what it is of."""
import copy

import pytest
from matplotlib.text import Text

import artists
import drawing
import layout
import phase_split
import style
from summary import NoData


def drawn(module, made):
    try:
        return drawing.of(module, made)
    except NoData as missing:
        pytest.skip(str(missing))


def test_a_backend_has_one_colour_in_all_figures(full, field):
    seen = {}
    for module in (module for module in drawing.MODULES if module is not phase_split):  # its colours are the phases'
        for made in (full, field):
            try:
                figure = drawing.of(module, made)
            except NoData:
                continue
            for backend, some in artists.colours(figure).items():
                seen.setdefault(backend, set()).update(some)
    assert seen == {backend: {colour.upper()} for backend, colour in style.BACKENDS.items()}
    assert len(set(style.BACKENDS.values())) == len(style.BACKENDS)


@pytest.mark.parametrize("module", drawing.MODULES, ids=lambda module: module.NAME)
def test_copies_made_for_the_self_test_are_in_its_figure_only(full, module):
    assert any(entry["point"]["backend"] == "slowed_5_symmetric_omp" for entry in full["points"])
    figure = drawn(module, full)
    said = [text.get_text() for text in figure.findobj(Text)]
    said += [artist.get_label() for axes in figure.axes for artist in (*axes.lines, *axes.containers)]
    assert not any("slowed_5" in str(text) for text in said)
    assert any("slowed 5 %" in str(text) for text in said) == (module.NAME == "self_test")


@pytest.mark.parametrize("module", drawing.MODULES, ids=lambda module: module.NAME)
def test_no_text_overlaps_another_or_leaves_the_page(any_made, module):
    assert artists.overlaps(drawn(module, any_made)) == []


@pytest.mark.parametrize("module", drawing.MODULES, ids=lambda module: module.NAME)
def test_on_a_page_there_is_no_title_and_nothing_is_cut(full, module):
    figure = module.draw(layout.for_page(full, 1))
    assert figure.texts == [] or all(not text.get_text() for text in figure.texts)
    assert figure.subtitle and artists.overlaps(figure) == []


def test_overlapping_texts_are_found(two):
    figure = copy.copy(drawing.MODULES[0].draw(two))
    figure.text(0.5, 0.5, "one text")
    figure.text(0.5, 0.5, "another text")
    assert ("one text", "another text") in artists.overlaps(figure)


@pytest.mark.parametrize("text", ["a$b$c", "$\\frac{1", "{{ 7 * 7 }}"])
def test_a_text_is_drawn_as_it_is(two, text):
    two["environments"][0]["cpu"] = text
    figure = drawing.MODULES[0].draw(two)
    artists.overlaps(figure)  # draws
    assert text in figure.texts[-1].get_text()
