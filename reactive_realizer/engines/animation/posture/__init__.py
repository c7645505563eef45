"""How the figure stands, sits and rests."""
