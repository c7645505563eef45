"""The page in a browser."""

import asyncio
import io

import numpy as np
import pytest
from PIL import Image
from playwright.async_api import Page, expect

from anticipators.metronome import Metronome
from reactive_realizer.embodiment.audio import AudioChange, AudioHeard, AudioMove, AudioStart
from reactive_realizer.realizer.inputs import TickInputs

from .conftest import Serve, far_away

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300), pytest.mark.asyncio(loop_scope="module")]

BML = 'xmlns="http://www.bml-initiative.org/bml/bml-1.0"'
BMLT = 'xmlns:bmlt="http://hmi.ewi.utwente.nl/bmlt"'
ALICE = '[character.alice]\nvoice = "en-us+f3"\n[anticipator.metronome]\nkind = "metronome"\n'
TWO = ALICE + '[character.bert]\navatar = "avatars/male.glb"\nposition = [1.0, 0.0, 0.0]\n'
GESTURE = f'<bml {BML} id="hand"><gesture id="g" lexeme="BEAT" mode="RIGHT_HAND" start="0.5"/></bml>'


async def send(page: Page, xml: str) -> None:
    await page.fill("#bml-text", xml)
    await page.click("#bml-form button[type=submit]")
    await expect(page.locator("#bml-answer")).to_have_text("Accepted")


async def test_the_page_shows_a_figure_and_loads_nothing_from_elsewhere(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        hips = await page.evaluate("viewer.bone('alice', 'Hips')")
        assert hips == pytest.approx([0, 0.95, 0], abs=0.1)
        head, foot = [await page.evaluate(f"viewer.bone('alice', '{bone}')[1]") for bone in ("Head", "LeftFoot")]
        assert head > 1.3
        assert foot < 0.2


@pytest.mark.parametrize(("query", "quality"), [("", "normal"), ("?quality=high", "high")])
async def test_it_shows_the_figure_in_full_quality_too(serve: Serve, query: str, quality: str) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open(query)
        assert await page.evaluate("viewer.quality") == quality


async def test_bml_that_is_sent_from_the_page_moves_the_arm_and_its_feedback_appears(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        before = await page.evaluate("viewer.bone('alice', 'RightHand')")
        await send(page, GESTURE)
        await page.wait_for_function(
            "before => Math.hypot(...viewer.bone('alice', 'RightHand').map((x, i) => x - before[i])) > 0.1", arg=before
        )
        await expect(page.locator("#feedback")).to_contain_text("hand:g:stroke")


async def test_buttons_and_keys_choose_a_shot_until_the_user_moves_the_camera(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        pressed = page.locator(".shots [aria-pressed=true]")
        await expect(pressed).to_have_text("Head and shoulders")
        whole = await page.locator("#viewport canvas").screenshot()
        await page.keyboard.press("1")
        await expect(pressed).to_have_text("Face")
        await page.click("#shot-full")
        await expect(pressed).to_have_text("Full body")
        assert await page.locator("#viewport canvas").screenshot() != whole
        await page.keyboard.press("3")
        await expect(pressed).to_have_text("Upper body")
        await page.fill("#bml-text", "")
        await page.type("#bml-text", "1")
        await expect(pressed).to_have_text("Upper body")
        await page.mouse.move(200, 200)
        await page.mouse.wheel(0, -100)
        await expect(pressed).to_have_count(0)


async def redness(page: Page) -> float:
    """By how much the picture of the figure is more red than green, on average, of 255."""
    shot = Image.open(io.BytesIO(await page.locator("#viewport canvas").screenshot())).convert("RGB")
    red, green, _ = np.moveaxis(np.asarray(shot, dtype=float), -1, 0)
    return float((red - green).clip(0.0).mean())


async def test_skin_reddens_when_a_character_blushes_and_greys_when_it_turns_pale(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        shown = {"": await redness(page)}
        for color in ("skinBlush", "skinPallor"):
            morph = f'<bmlt:facemorph id="m" targetname="{color}" start="0" attackPeak="0.2" relax="60" end="61"/>'
            await send(page, f'<bml {BML} {BMLT} id="{color}" composition="REPLACE">{morph}</bml>')
            await page.wait_for_function("color => viewer.morph('alice', color) > 0.99", arg=color)
            shown[color] = await redness(page)
        assert shown["skinPallor"] < 0.9 * shown[""] < 1.1 * shown[""] < shown["skinBlush"]


async def test_bml_that_is_wrong_is_answered_in_the_page_as_text(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        await page.fill("#bml-text", f'<bml {BML} id="b"><img src="x" onerror="alert(1)"')
        await page.click("#bml-form button[type=submit]")
        await expect(page.locator("#bml-answer")).to_have_text("Refused")
        await expect(page.locator("#bml-mistakes .refused")).to_contain_text("line 1")
        assert await page.locator("#bml-form img, #feedback img").count() == 0


async def test_warnings_appear_below_the_editor_and_a_click_selects_the_line(serve: Serve) -> None:
    lines = [f'<bml {BML} id="b">', *["  <!-- a long document -->"] * 40, '  <gesture id="g" lexeme="BAET"/>', "</bml>"]
    async with serve(ALICE) as scene:
        page = await scene.open()
        await page.fill("#bml-text", "\n".join(lines))
        await page.evaluate("document.querySelector('#bml-text').scrollTop = 0")
        await page.click("#bml-form button[type=submit]")
        await expect(page.locator("#bml-answer")).to_have_text("Accepted, 1 warning")
        await expect(page.locator("#bml-mistakes li")).to_contain_text("did you mean 'BEAT'?")
        await page.click("#bml-mistakes button")
        selection, scrolled = await page.evaluate("[String(getSelection()), document.activeElement.scrollTop]")
        assert selection == lines[41]
        assert scrolled > 0, "the line is in view"
        await send(page, f'<bml {BML} id="c"><head id="h" lexeme="NOD"/></bml>')
        await expect(page.locator("#bml-mistakes")).to_be_hidden()


@pytest.mark.speech
async def test_speech_sounds_and_moves_the_mouth(serve: Serve) -> None:
    async with serve(ALICE, voice="espeak") as scene:
        page = await scene.open()
        text = "Round the rugged rock the ragged rascal ran, and on he went for ever."
        await send(page, f'<bml {BML} id="say"><speech id="s" start="1"><text>{text}</text></speech></bml>')
        await page.wait_for_function("() => viewer.speech.some(clip => clip.begin !== null)")
        await page.wait_for_function("() => viewer.morph('alice', 'jawOpen') > 0.05")
        await expect(page.locator("#feedback")).to_contain_text("say:s:end")
        await page.wait_for_function("() => viewer.morph('alice', 'jawOpen') < 0.05")


# Notes in each animation frame what the captions say, with the word that they mark, if it is new.
NOTE_CAPTIONS = """() => {
  window.shown = [];
  const captions = document.querySelector("#captions");
  (function note() {
    const [text, word] = [captions.textContent, captions.querySelector("mark")?.textContent ?? ""];
    const [last] = shown.slice(-1);
    if (last?.[0] !== text || last[1] !== word) shown.push([text, word]);
    requestAnimationFrame(note);
  })();
}"""


@pytest.mark.speech
async def test_captions_mark_the_word_that_is_heard_end_where_it_is_cut_and_can_be_hidden(serve: Serve) -> None:
    async with serve(ALICE, voice="espeak") as scene:
        page = await scene.open()
        await page.evaluate(NOTE_CAPTIONS)
        text = "It is a story which everybody has begun to tell, but nobody ever heard its end."
        await send(page, f'<bml {BML} id="say"><speech id="s"><text>{text}</text></speech></bml>')
        await page.wait_for_function("() => shown.length > 4")
        await send(page, f'<bml {BML} id="stop" composition="REPLACE"/>')
        await page.wait_for_function("() => shown.length > 1 && shown.at(-1)[0] === ''")
        first, *readings, cut, last = await page.evaluate("shown")
        assert first == last == ["", ""]
        assert {reading for reading, _ in readings} == {text}
        words = [word for _, word in readings]
        assert words == [word for word in text.replace(",", "").split() if word in words]
        assert cut[0].endswith(f"{cut[1]}—")
        assert text.startswith(cut[0].removesuffix("—"))

        await page.click("#captions-switch")
        await send(page, f'<bml {BML} id="again"><speech id="s"><text>{text}</text></speech></bml>')
        await page.wait_for_function("before => shown.slice(before).some(([, word]) => word)", arg=len(readings) + 3)
        await expect(page.locator("#captions")).to_be_hidden()


@pytest.mark.speech
async def test_a_page_that_is_opened_late_plays_the_speech_from_its_current_position(serve: Serve) -> None:
    async with serve(TWO, voice="espeak") as scene:
        first = await scene.open()
        text = "This is a long story about a patient speaker. " * 8
        await send(first, f'<bml {BML} id="say"><speech id="s"><text>{text}</text></speech></bml>')
        await first.wait_for_function("() => viewer.speech.some(clip => clip.begin !== null)")
        late = await scene.open()
        await late.wait_for_function("() => viewer.speech.some(clip => clip.begin !== null)")
        starts = [await page.evaluate("viewer.speech[0].start") for page in (first, late)]
        assert starts[0] == starts[1]
        await late.wait_for_function("() => viewer.morph('alice', 'jawOpen') > 0.05")


@pytest.mark.speech
async def test_a_page_far_away_plays_speech_from_its_first_word_without_fetching_it(serve: Serve) -> None:
    async with serve(ALICE, voice="espeak") as scene, far_away(scene.address, 0.3) as address:
        page = await scene.open(address=address)
        await page.evaluate(NOTE_STARTS)
        fetched: list[str] = []
        page.on("request", lambda request: fetched.append(request.url))
        for number in range(2):
            await send(page, f'<bml {BML} id="b{number}"><speech id="s"><text>one two three four</text></speech></bml>')
            await expect(page.locator("#feedback")).to_contain_text(f"b{number}:s:end")
        assert not any(url.endswith(".wav") for url in fetched)
        # A machine that is so slow that the sound comes a second late leaves out that.
        assert 0 in await page.evaluate("offsets")
        await page.close()


NOTE_STARTS = """
window.offsets = [];
const {start} = AudioBufferSourceNode.prototype;
AudioBufferSourceNode.prototype.start = function(at, offset) { offsets.push(offset); start.call(this, at, offset); };
null
"""

DELAY = """
window.delay = 0;
const {get} = Object.getOwnPropertyDescriptor(AudioContext.prototype, 'outputLatency');
Object.defineProperty(AudioContext.prototype, 'outputLatency', {get() { return get.call(this) + window.delay; }});
"""


@pytest.mark.speech
async def test_a_speech_whose_sound_is_delayed_moves_to_what_is_heard(serve: Serve) -> None:
    async with serve(ALICE, voice="espeak") as scene:
        reports: list[AudioHeard] = []
        sounds: list[AudioChange] = []
        realizer = scene.live.realizer
        several = asyncio.Event()

        def note(entered: TickInputs) -> None:
            reports.extend(each for each in entered.inputs if isinstance(each, AudioHeard))
            if len(reports) >= 4:
                several.set()

        realizer.record(note)
        realizer.hear(sounds.append)
        page = await scene.open()
        await page.evaluate(DELAY)
        text = "Round the rugged rock the ragged rascal ran, and on he went for ever. " * 3
        await send(page, f'<bml {BML} id="say"><speech id="s" start="1"><text>{text}</text></speech></bml>')
        await page.wait_for_function("() => viewer.speech.some(clip => clip.begin !== null)")
        await asyncio.wait_for(several.wait(), 20)
        (start,) = [each.start for each in sounds if isinstance(each, AudioStart)]
        assert start is not None
        before, moved = len(sounds), await page.evaluate("[viewer.speech[0].start, viewer.speech[0].begin]")
        await page.evaluate("delay = 0.3")
        await page.wait_for_function("start => viewer.speech[0].start > start + 0.2", arg=moved[0])
        assert await page.evaluate("viewer.speech[0].begin") == moved[1], "the page does not seek"
        *_, move = [each.start for each in sounds[before:] if isinstance(each, AudioMove)]
        # Where the browser itself lags, it reports that too.
        heard = [each.time - each.position for each in reports]
        assert max(start + 0.2, min(heard) - 0.03) < move < max(heard) + 0.03
        await expect(page.locator("#feedback")).to_contain_text("say:s:end")


async def test_each_of_two_figures_performs_its_own_behavior(serve: Serve) -> None:
    async with serve(TWO) as scene:
        page = await scene.open()
        roots = [await page.evaluate(f"viewer.bone('{id_}', 'Hips')[0]") for id_ in ("alice", "bert")]
        assert roots == pytest.approx([0, 1], abs=0.1)
        before = {id_: await page.evaluate(f"viewer.bone('{id_}', 'RightHand')[1]") for id_ in ("alice", "bert")}
        await send(page, GESTURE.replace("<bml", '<bml characterId="bert"'))
        await page.wait_for_function("y => viewer.bone('bert', 'RightHand')[1] - y > 0.1", arg=before["bert"])
        assert abs(await page.evaluate("viewer.bone('alice', 'RightHand')[1]") - before["alice"]) < 0.05


async def test_the_tempo_of_the_metronome_is_dragged_in_the_page(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        await page.locator("#tempo").fill("120")
        await expect(page.locator("#tempo-value")).to_contain_text("120")
        metronome = scene.live.realizer.anticipators["metronome"]
        assert isinstance(metronome, Metronome)
        while round(metronome.tempo) != 120:
            await page.wait_for_function("last => viewer.lastFrameTime > last", arg=scene.live.now)


async def test_the_space_bar_is_followed_while_nothing_has_the_focus(serve: Serve) -> None:
    async with serve(ALICE + '[anticipator.spacebar]\nkind = "spacebar"\n') as scene:
        page = await scene.open()
        await send(page, f'<bml {BML} id="b"><wait id="w" start="anticipators:spacebar:press" duration="0.1"/></bml>')
        typed = page.locator("#bml-text")
        before = await typed.input_value()
        await typed.press("Space")
        assert len(await typed.input_value()) == len(before) + 1
        await page.evaluate("document.activeElement.blur()")
        await page.keyboard.down("Space")
        await expect(page.locator("#feedback")).to_contain_text("b:w:start")
        await page.keyboard.up("Space")


async def test_the_board_lists_pegs_and_what_moved_them(serve: Serve) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        await page.click("#pegs-tab")
        await send(page, f'<bml {BML} id="late"><wait id="w" start="anticipators:test:hit" duration="30"/></bml>')
        await expect(page.locator("#pegs-rows")).to_contain_text("late:w:end")
        await expect(page.locator("#pegs-rows")).to_contain_text("anticipators:test:hit")


async def test_physics_is_turned_on_and_off_and_a_figure_that_is_pushed_over_is_put_back(serve: Serve) -> None:
    head = "viewer.bone('alice', 'Head')"
    async with serve(ALICE) as scene:
        page = await scene.open()
        tall = (await page.evaluate(head))[1]
        await page.locator("#push-impulse").fill("60")
        await page.click("#push-front")
        await page.check("#physics-on")
        await expect(page.locator("#feedback")).to_contain_text(":legs:start")
        await expect(page.locator("#physics-on")).to_be_checked()
        # Before, the push had no effect; now, one does.
        assert (await page.evaluate(head))[1] == pytest.approx(tall, abs=0.03)
        await page.click("#push-back")
        await expect(page.locator("#feedback .row.fall")).to_contain_text("alice has fallen")
        await page.wait_for_function(f"() => {head}[1] < 0.5 && {head}[2] > 0.3")
        await page.click("#reset")
        await expect(page.locator("#physics-bml")).to_be_checked()
        await page.wait_for_function(f"tall => Math.abs({head}[1] - tall) < 0.03", arg=tall)
        await page.check("#physics-on")
        await expect(page.locator("#physics-on")).to_be_checked()
        await page.check("#physics-off")
        await expect(page.locator("#physics-off")).to_be_checked()
        await page.click("#push-front")
        await send(page, f'<bml {BML} id="late"><wait id="w" duration="1.5"/></bml>')
        await expect(page.locator("#feedback")).to_contain_text("late:w:end")
        assert (await page.evaluate(head))[1] == pytest.approx(tall, abs=0.03)
        assert await page.locator("#feedback .row.fall").count() == 1


async def test_the_path_and_the_footprints_of_a_walk_are_asked_for_and_shown_while_their_button_is_pressed(
    serve: Serve,
) -> None:
    async with serve(ALICE) as scene:
        page = await scene.open()
        async with page.expect_websocket() as opened:
            await page.click("#steps-switch")
        socket = await opened.value
        assert socket.url.endswith("?streams=steps")
        await send(page, f'<bml {BML} id="go"><locomotion id="w" target="0.8 1"/></bml>')
        await page.wait_for_function("() => viewer.footprints('alice') > 4")
        async with socket.expect_event("close"):
            await page.click("#steps-switch")
        assert await page.evaluate("viewer.footprints('alice')") == 0
