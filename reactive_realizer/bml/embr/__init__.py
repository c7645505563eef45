"""EMBRScript, the language of EMBR's animation layer, as a dialect: its scripts are read as blocks of BML."""
