"""The checker of external references must find what is planted, and nothing else."""
import pytest

import browser
import page_check


@pytest.mark.parametrize("planted", [
    '<img src="https://example.org/a.png">', '<img src="a.png">', '<img srcset="//example.org/a.png 2x">',
    '<link rel="stylesheet" href="http://example.org/a.css">', '<script src="a.js"></script>',
    "<style>@import 'a.css';</style>", "<style>p { background: url(https://example.org/a.png) }</style>",
    '<p style="background:url(a.png)">text</p>', '<svg><use href="other.svg#a"/></svg>',
    '<svg><image xlink:href="http://example.org/a.png"/></svg>',
    "<script>fetch('https://example.org/')</script>", '<iframe src="https://example.org"></iframe>',
    '<form action="https://example.org"></form>', '<a href="https://example.org">away</a>'])
def test_what_is_planted_is_found(page, planted):
    html = page.read_text()
    assert page_check.external(html) == []
    assert len(page_check.external(html.replace("<main>", f"<main>{planted}"))) >= 1


@pytest.mark.parametrize("harmless", [
    '<svg xmlns="http://www.w3.org/2000/svg" clip-path="url(#a)"></svg>', '<a href="#figures">figures</a>',
    '<img src="data:image/png;base64,AAAA">', "<p>see https://example.org</p>"])
def test_what_loads_nothing_is_left_alone(harmless):
    assert page_check.external(harmless) == []


def test_the_browser_sees_a_planted_image_too(page, chromium, tmp_path):
    planted = tmp_path / "planted.html"
    html = page.read_text().replace("<main>", '<main><img src="http://127.0.0.1:9/planted.png">')
    planted.write_text(html)
    browser.show(chromium, planted)
    assert any("planted.png" in line and "Content Security Policy" in line for line in browser.console(chromium))
    planted.write_text(html.replace("Content-Security-Policy", "ignored"))
    browser.show(chromium, planted)
    assert any("planted.png" in address for address in browser.requests(chromium, planted))
