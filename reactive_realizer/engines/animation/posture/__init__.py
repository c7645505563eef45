"""How the figure stands, sits and lies, how it holds arms and legs, and how its feet stay where they stand."""
