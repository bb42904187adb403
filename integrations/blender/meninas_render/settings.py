"""What the user chooses, in the scene and in the preferences, and the options of the program that say it."""

import bpy

PACKAGE = __package__


class MeninasPreferences(bpy.types.AddonPreferences):
    bl_idname = PACKAGE

    program: bpy.props.StringProperty(
        name="Program",
        description="The program meninas: a name that is looked for in PATH, or a file",
        subtype="FILE_PATH",
        default="meninas",
    )

    def draw(self, context):
        self.layout.prop(self, "program")


class MeninasSettings(bpy.types.PropertyGroup):
    accuracy: bpy.props.EnumProperty(
        name="Accuracy",
        description="What decides how fine the picture is",
        items=(
            ("QUALITY", "Quality", "One of three presets"),
            ("ERROR", "Error", "Choose settings until the picture is about so far off"),
            ("TIME", "Time", "The best picture within a time"),
        ),
        default="QUALITY",
    )
    quality: bpy.props.EnumProperty(
        name="Quality",
        items=(
            ("draft", "Draft", "Fast: shadows are as coarse as the mesh"),
            ("normal", "Normal", "Direct light is as fine as the pixels"),
            ("fine", "Fine", "Four times the elements, rays and samples"),
        ),
        default="normal",
    )
    error: bpy.props.FloatProperty(
        name="Error", description="Relative error of the picture", default=0.02, min=0.001, max=0.5, precision=3
    )
    seconds: bpy.props.FloatProperty(name="Seconds", default=20.0, min=0.5, soft_max=600.0)
    use_mirrors: bpy.props.BoolProperty(
        name="Mirrors",
        description="Show what mirrors and glossy surfaces reflect. Off, they are black, and still light the room",
        default=True,
    )
    use_lamps: bpy.props.BoolProperty(
        name="Lamps Apart", description="A pass for each lamp and the sky; takes a second run", default=False
    )
    use_passes: bpy.props.BoolProperty(
        name="Passes of Light",
        description="Emission, direct and mirrored light, each also as seen in mirrors, and albedo",
        default=True,
    )
    bake_of: bpy.props.EnumProperty(
        name="Bake",
        items=(
            ("RADIOSITY", "Radiosity", "Light that leaves the surface, W/m^2"),
            ("IRRADIANCE", "Irradiance", "Light that falls on the surface, W/m^2"),
        ),
        default="RADIOSITY",
    )


def program_path(context):
    addon = context.preferences.addons.get(PACKAGE)
    return addon.preferences.program if addon else "meninas"


def accuracy_settings(settings):
    """Options by their names without dashes, as batches have them."""
    if settings.accuracy == "ERROR":
        return {"error": round(settings.error, 6)}
    if settings.accuracy == "TIME":
        return {"time": round(settings.seconds, 3)}
    return {"quality": settings.quality}


def options_of(settings):
    return [word for name, value in settings.items() for word in (f"--{name}", str(value))]


def layers_of(settings):
    """Light is told apart by how it came to mirrors' pictures, which are black without mirrors."""
    light = ["light"] if settings.use_passes and settings.use_mirrors else []
    return ",".join(light + (["albedo"] if settings.use_passes else []) + ["depth", "normal"])


def mode_of(settings):
    return "hybrid" if settings.use_mirrors else "radiosity"
