"""Taking the turn when the user has finished (thesis, examples 8 and 17).

A user asks a question and hesitates. The anticipator `user` receives the output of a voice detector and a speech
recognizer, and predicts the end of the turn. A nod is tied to it, and the answer starts shortly after it. The planner
sends its block once, while the user still speaks, and does nothing more.

Watch the predicted start of the answer: unknown while the user speaks, soon during the pause, sooner after words that
can end a sentence, and later after words that need a continuation.
"""

import asyncio

from example_scene import ExampleScene, open_example

REPLY = """
<bml xmlns="http://www.bml-initiative.org/bml/bml-1.0" id="reply">
  <gaze id="listening" target="viewer" start="0" end="words:end"/>
  <head id="nod" lexeme="NOD" start="anticipators:user:stop"/>
  <speech id="words" start="anticipators:user:stop+0.2"><text>Down the stairs, and then to the left.</text></speech>
</bml>
"""
HEARD = [
    (0.2, "voice", 1.0, None),
    (1.9, "voice", 0.0, None),
    (2.1, "words", None, "I would like to know the"),
    (2.7, "voice", 1.0, None),
    (4.3, "voice", 0.0, None),
    (4.4, "words", None, "I would like to know the way to the trains."),
]


def expected(scene: ExampleScene) -> str:
    """The last predicted start of the answer, in words."""
    *_, reply = scene.feedback.predictions("reply")[-1].element
    start = reply.get("start")
    return "not expected yet" if start is None else f"expected at {float(start):.2f}"


async def main() -> ExampleScene:
    async with open_example("reply:nod:start", "reply:words:*") as scene:
        scene.perform(REPLY)
        for time, name, value, text in HEARD:
            await scene.until(time)
            scene.event("user", name, value, text)
            await scene.tick()
            what = f'understood "{text}"' if text else f"voice {'on' if value else 'off'}"
            scene.log(f"{what}: the answer is {expected(scene)}", time)
        await scene.until(10)
        return scene


if __name__ == "__main__":
    asyncio.run(main())
