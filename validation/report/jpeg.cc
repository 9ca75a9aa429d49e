#include "validation/report/jpeg.h"

#include <vtkJPEGWriter.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkUnsignedCharArray.h>

#include <cstddef>

namespace pelvireg::report
{
std::string jpeg_of_png(const std::filesystem::path &file)
{
  vtkNew<vtkPNGReader> reader;
  if (!std::filesystem::exists(file) || reader->CanReadFile(file.c_str()) == 0)
    return "";
  reader->SetFileName(file.c_str());
  vtkNew<vtkJPEGWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetQuality(90);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray *bytes = writer->GetResult();
  if (bytes == nullptr)
    return "";
  return {reinterpret_cast<const char *>(bytes->GetPointer(0)), static_cast<std::size_t>(bytes->GetNumberOfValues())};
}
} // namespace pelvireg::report
