"""The parts of the thesis's examples of scheduling (27 to 29; 7.1.3, 7.2.2), as BML."""

SPEECH = '<speech id="speech1"><text>Yes, <sync id="sync1"/>that was great.</text></speech>'
NOD_ON_SPEECH = '<head id="nod1" lexeme="NOD" start="speech1:start" end="speech1:sync1"/>'
NOD_3_TO_5 = '<head id="nod1" lexeme="NOD" start="3" end="5"/>'
BEAT_ON_NOD = '<gesture id="beat1" lexeme="BEAT" stroke="nod1:stroke"/>'
BEATS = '<gesture id="g1" lexeme="BEAT"/><gesture id="g2" lexeme="BEAT" start="g1:end"/>'
NOD_AROUND = '<head id="nod1" lexeme="NOD" repetition="5" start="g1:start-2" end="g2:end+3"/>'
