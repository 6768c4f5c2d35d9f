#!/usr/bin/python3
"""Puts pictures into one, with a caption under each.

usage: contact_sheet.py OUT.png COLUMNS WIDTH HEIGHT CAPTION=FILE...
A tile whose FILE is empty stays grey: its caption says what is left out. Pictures of another size are scaled.
"""
import sys

from PIL import Image, ImageDraw

CAPTION_HEIGHT = 16  # pixels


def tile(caption, file, width, height):
    picture = Image.new("RGB", (width, height + CAPTION_HEIGHT), (40, 40, 40))
    if file:
        picture.paste(Image.open(file).convert("RGB").resize((width, height), Image.LANCZOS), (0, 0))
    else:
        picture.paste((110, 110, 110), (0, 0, width, height))
    ImageDraw.Draw(picture).text((4, height + 2), caption, fill=(235, 235, 235))
    return picture


def main(arguments):
    if len(arguments) < 5 or any("=" not in entry for entry in arguments[4:]):
        sys.exit(__doc__)
    out, (columns, width, height) = arguments[0], map(int, arguments[1:4])
    tiles = [tile(*entry.rsplit("=", 1), width, height) for entry in arguments[4:]]
    rows = (len(tiles) + columns - 1) // columns
    sheet = Image.new("RGB", (columns * width, rows * (height + CAPTION_HEIGHT)))
    for i, picture in enumerate(tiles):
        sheet.paste(picture, (i % columns * width, i // columns * (height + CAPTION_HEIGHT)))
    sheet.save(out)


main(sys.argv[1:])
