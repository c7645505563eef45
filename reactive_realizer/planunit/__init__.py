"""What is played between pegs: units with sync points and preferred timing, whatever the modality.

The room knows pegs and BML descriptions; it knows no engine and no scheduler.
"""
