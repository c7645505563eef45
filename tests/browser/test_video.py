"""Videos of `realize`: the page is filmed picture by picture, with the sound."""

from pathlib import Path

import av
import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from reactive_realizer.__main__ import main
from reactive_realizer.testing.pilot import block

SIZE = (320, 180)
WAVE = block("b", '<gesture id="g" lexeme="WAVE" start="0.2"/>')
SPEECH = block("b", '<speech id="s" start="0.5"><text>Stop!</text></speech>')


def video_of(folder: Path, text: str, *options: str) -> Path:
    """The video that ``realize`` writes of a document."""
    (folder / "a.xml").write_text(text, encoding="utf-8")
    file = folder / "out.mp4"
    width, height = SIZE
    arguments = ["realize", str(folder / "a.xml"), "--video", str(file), "--video-size", f"{width}x{height}", *options]
    assert main(arguments) == 0
    return file


def pictures_of(file: Path) -> list[NDArray[np.float64]]:
    with av.open(file) as video:
        assert [float(stream.average_rate or 0) for stream in video.streams.video] == [25.0]
        return [frame.to_ndarray(format="gray").astype(float) for frame in video.decode(video=0)]


@pytest.mark.browser
@pytest.mark.usefixtures("chromium")
def test_a_video_has_a_picture_for_each_twenty_fifth_of_a_second_of_the_session(tmp_path: Path) -> None:
    pictures = pictures_of(video_of(tmp_path, WAVE, "--voice", "text", "--shot", "full", "--until", "1.2"))
    assert len(pictures) == 1.2 * 25 + 1
    assert pictures[0].shape == SIZE[::-1]
    before, still, raised = (pictures[number] for number in (0, 4, 30))
    assert np.abs(raised - before).mean() > 3 * np.abs(still - before).mean()


@pytest.mark.browser
@pytest.mark.usefixtures("chromium")
def test_the_sound_of_a_video_is_that_of_the_session(tmp_path: Path) -> None:
    file = video_of(tmp_path, SPEECH, "--voice", "espeak", "--audio", str(tmp_path / "out.wav"))
    expected, rate = soundfile.read(tmp_path / "out.wav")
    with av.open(file) as video:
        sound = np.concatenate([frame.to_ndarray()[0] for frame in video.decode(audio=0)])
    assert rate == 48_000
    begin, wanted = (int(np.argmax(np.abs(each) > 0.05)) / rate for each in (sound, expected))
    assert begin == pytest.approx(wanted, abs=0.03)
    assert wanted > 0.5


def test_a_video_needs_the_virtual_clock_and_even_sizes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.xml").write_text(WAVE, encoding="utf-8")
    wanted = ["realize", str(tmp_path / "a.xml"), "--video", str(tmp_path / "out.mp4")]
    for options, reason in ((["--clock", "real"], "virtual"), (["--video-size", "321x180"], "321x180")):
        with pytest.raises(SystemExit):
            main([*wanted, *options])
        assert reason in capsys.readouterr().err


def test_a_video_without_a_browser_is_refused_before_the_session(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("PLAYWRIGHT_BROWSERS_PATH", str(tmp_path))
    (tmp_path / "a.xml").write_text(WAVE, encoding="utf-8")
    assert main(["realize", str(tmp_path / "a.xml"), "--video", str(tmp_path / "out.mp4")]) == 2
    assert "a video cannot be made: " in capsys.readouterr().err
    assert not (tmp_path / "out.mp4").exists()
