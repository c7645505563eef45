"""How the figure stands, sits and lies, how it holds arms and legs, and how its feet stay where they stand.

It reads the files of other rooms, and sees what else moves the body only as layers: whose they are it does not know.
"""
