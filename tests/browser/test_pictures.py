"""A character of pictures in the page."""

from pathlib import Path

import pytest
from playwright.async_api import expect

from .conftest import Serve

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300), pytest.mark.asyncio(loop_scope="module")]

EXAMPLE = Path("examples/pictures")
SMILE = (
    '<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="b">'
    '<faceLexeme id="f" lexeme="SMILE" start="0" end="600"/></bml>'
)


async def test_the_page_shows_pictures_on_their_layers(serve: Serve) -> None:
    async with serve((EXAMPLE / "human.toml").read_text(encoding="utf-8"), assets=(EXAMPLE,)) as scene:
        page = await scene.open()
        figure = page.get_by_role("img", name="paula")
        await expect(figure.locator('img[src$="rest.png"]')).to_be_visible()
        await page.fill("#bml-text", SMILE)
        await page.click("#bml-form button[type=submit]")
        smile = figure.locator('img[src$="smile.png"]')
        await expect(smile).to_be_visible()
        assert await smile.evaluate("picture => picture.naturalWidth") == 320
        assert await smile.evaluate("picture => Number(picture.style.zIndex)") == 2
