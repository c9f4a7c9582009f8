# Opens what `spheroscope export` wrote, in ParaView, and saves a picture: cells cut open, coloured by sigma_h.
# Use: pvbatch paraview.py CELLS.pvd PICTURE.png
import sys
from paraview.simple import *

cells = PVDReader(FileName=sys.argv[1])
cells.UpdatePipeline()
view = CreateView('RenderView')
view.ViewSize = [1000, 800]
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
half = Clip(Input=cells, ClipType='Plane', Crinkleclip=1)
half.ClipType.Normal = [1, 0, 0]
half.ClipType.Origin = [0, 0, 0]
display = Show(half, view)
ColorBy(display, ('CELLS', 'sigma_h (kPa)'))
colours = GetColorTransferFunction('sigma_h (kPa)')
colours.ApplyPreset('Cool to Warm', True)
cells.UpdatePipeline()
low, high = cells.CellData['sigma_h (kPa)'].GetRange()
bound = max(-low, high)
colours.RescaleTransferFunction(-bound, bound)
display.SetScalarBarVisibility(view, True)
bar = GetScalarBar(colours, view)
bar.Title, bar.ComponentTitle = 'sigma_h, kPa', ''
bar.TitleColor = bar.LabelColor = [0, 0, 0]
view.CameraPosition = [220, 60, 40]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]
Render(view)
SaveScreenshot(sys.argv[2], view)
print('points', cells.GetDataInformation().GetNumberOfPoints(), 'range', low, high)
